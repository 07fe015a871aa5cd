// SPDX-License-Identifier: GPL-3.0-or-later
// The points of a curve: of the model file, or of a CSV file beside it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "language/dimension.hpp"
#include "read/rules.hpp"
#include "text/data_file.hpp"
#include "text/nearest.hpp"

namespace dalembert {

namespace {

Excerpt part_of(const Excerpt& whole, std::size_t begin, std::size_t end) {
    const auto at = [&](std::size_t i) { return whole.offsets.begin() + static_cast<std::ptrdiff_t>(i); };
    return {whole.source, whole.text.substr(begin, end - begin), {at(begin), at(end) + 1}};
}

/// In SI, but for the power of pi.
Rational scaled(const Rational& value, const Unit& unit) { return (value + unit.offset) * unit.factor; }

class CurveReader {
public:
    CurveReader(const Entry& e, Curve& curve) : e_(e), curve_(curve) {}

    void run() {
        read_variable();
        if (e_.has("points") && e_.has("file"))
            return e_.error(Id::doubly_defined, e_.span_of("file"),
                            fmt::format("curve '{}' has points and a file; one of them says what the other does", curve_.name));
        if (!e_.has("points") && !e_.has("file"))
            return e_.error(Id::missing_key, e_.span(), fmt::format("curve '{}' needs points or a file with points", curve_.name));
        if (e_.has("columns") && !e_.has("file"))
            e_.error(Id::unknown_key, e_.span_of("columns"),
                     fmt::format("curve '{}' has points and no file, of which the columns could be", curve_.name));
        if (e_.has("points") ? read_points() : read_file()) check_points();
    }

private:
    /// "x [mm]"
    void read_variable() {
        const auto text = e_.excerpt("of");
        if (!text) return;
        const std::size_t open = text->text.find('['), close = text->text.rfind(']');
        const std::string after = close == std::string::npos ? "" : text->text.substr(close + 1);
        std::size_t end = std::min(open, text->text.size());
        while (end > 0 && text->text[end - 1] == ' ') --end;
        curve_.variable = text->text.substr(0, end);
        const auto is_letter = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
        const bool is_name = !curve_.variable.empty() && std::isdigit(static_cast<unsigned char>(curve_.variable[0])) == 0 &&
                             std::all_of(curve_.variable.begin(), curve_.variable.end(), is_letter);
        if (!is_name || open == std::string::npos || close == std::string::npos || close < open || !after.empty())
            return e_.error(Id::syntax, text->whole(),
                            fmt::format("'{}' is not a variable with its unit, as in 'x [mm]' or 'x [1]'", text->text));
        try {
            curve_.of = parse_unit(part_of(*text, open + 1, close));
        } catch (const Failure& failure) {
            for (const Diagnostic& d : failure.diagnostics()) e_.error(d.id, d.span, d.message, d.notes);
        }
    }

    bool read_points() {
        bool all_there = true;
        const auto number = [&](const ExpressionPtr& value) -> Rational {
            if (value && value->kind == Expression::Kind::number && value->name.empty()) return value->value;
            all_there = false;
            if (value)
                e_.error(Id::wrong_type, value->span,
                         fmt::format("'{}' is not a number; points of curve '{}' are numbers in '{}' and '{}'", value->written(),
                                     curve_.name, curve_.of.written, curve_.unit.written));
            return 0;
        };
        const auto points = e_.points("points");
        for (const auto& [x, y] : points) {
            const Rational at = number(x), value = number(y);
            if (x && y) curve_.points.push_back({scaled(at, curve_.of), scaled(value, curve_.unit), cover(x->span, y->span)});
        }
        // What was no pair has been told.
        return all_there && e_.is_list("points") && points.size() == e_.length("points") && curve_.points.size() == points.size();
    }

    bool read_file() {
        const std::string written = e_.text("file");
        if (written.empty()) {
            if (e_.excerpt("file"))
                e_.error(Id::wrong_type, e_.span_of("file"), fmt::format("the file of curve '{}' needs a name", curve_.name));
            return false;
        }
        try {
            const Span place = e_.span_of("file");
            const auto path = std::filesystem::path(place.source->name()).parent_path() / written;
            DataFile file;
            try {
                file = read_data_file(path);
            } catch (const Failure& failure) {
                const Diagnostic& first = failure.diagnostics().front();
                if (first.id != Id::unreadable_file) throw;
                throw Failure(Diagnostic{first.id, place,
                                         fmt::format("{}; the path of the points of curve '{}' begins beside the model file",
                                                     first.message, curve_.name)});
            }
            return take(file);
        } catch (const Failure& failure) {
            for (const Diagnostic& d : failure.diagnostics()) e_.error(d.id, d.span, d.message, d.notes);
            return false;
        }
    }

    /// Whether it has points, whatever they are.
    bool take(const DataFile& file) {
        std::array<std::pair<std::string, Span>, 2> names{std::pair{curve_.variable, e_.span_of("file")},
                                                          std::pair{curve_.name, e_.span_of("file")}};
        if (e_.has("columns")) {
            const auto columns = e_.names("columns");
            const std::size_t count = e_.length("columns");
            if (!e_.is_list("columns") || columns.size() != count) return false;  // told
            const bool is_twice = count == 2 && columns[0].first == columns[1].first;
            if (count != 2 || is_twice)
                throw Failure(Diagnostic{Id::wrong_arguments, e_.span_of("columns"),
                                         fmt::format("curve '{}' takes two columns, that of '{}' and that of the values; here {}",
                                                     curve_.name, curve_.variable,
                                                     is_twice     ? "both are '" + columns[0].first + "'"
                                                     : count == 0 ? "none is named"
                                                     : count == 1 ? "one is named"
                                                                  : fmt::format("{} are named", count))});
            names = {columns[0], columns[1]};
        }
        std::array<const DataColumn*, 2> found{};
        for (std::size_t i = 0; i < 2; ++i)
            if (found[i] = file.find(names[i].first); found[i] == nullptr)
                throw Failure(Diagnostic{
                    Id::unknown_name, names[i].second,
                    fmt::format("the file has no column '{}', for the {} of curve '{}'; its columns are {}", names[i].first,
                                i == 0 ? "variable" : "values", curve_.name, quoted_list(file.names()))});
        const Unit units[]{unit_of(*found[0], curve_.of), unit_of(*found[1], curve_.unit)};
        for (std::size_t row = 0; row < file.lines.size(); ++row) {
            Curve::Point& point = curve_.points.emplace_back();
            point.span = file.place(row);
            point.x = scaled(number(file, *found[0], row), units[0]);
            point.y = scaled(number(file, *found[1], row), units[1]);
        }
        return true;
    }

    Rational number(const DataFile& file, const DataColumn& column, std::size_t row) const {
        if (std::isnan(column.values[row]))
            throw Failure(Diagnostic{Id::missing_key, file.place(row),
                                     fmt::format("the line has no number in column '{}', and each point of curve '{}' needs one",
                                                 column.name, curve_.name)});
        const std::string text = file.written(column, row);
        const auto value = read_decimal(text);
        if (!value)
            throw Failure(Diagnostic{Id::wrong_type, file.place(row),
                                     fmt::format("'{}' is not a decimal number with an exponent between -400 and 400", text)});
        return *value;
    }

    /// That of the title, or else the declared one.
    Unit unit_of(const DataColumn& column, const Unit& declared) const {
        if (column.unit.empty() || column.unit == declared.written) return declared;
        const std::string& text = column.place.source->text();
        const std::size_t at = text.find(column.unit, text.find('[', column.place.begin));
        const Unit unit = parse_unit(excerpt_of(column.place.source, at, at + column.unit.size()));
        if (!(unit.dimension == declared.dimension) || unit.pi_power != declared.pi_power)
            throw Failure(Diagnostic{Id::unit_mismatch, column.place,
                                     fmt::format("the column '{}' is in '{}', but curve '{}' counts it in '{}'; use the unit of the column "
                                                 "for both",
                                                 column.name, column.unit, curve_.name, declared.written)});
        return unit;
    }

    void check_points() const {
        if (curve_.points.size() < 2)
            return e_.error(Id::value_out_of_range, e_.has("points") ? e_.span_of("points") : e_.span_of("file"),
                            fmt::format("curve '{}' has {}, but needs two or more", curve_.name,
                                        curve_.points.empty() ? "no point" : "one point"));
        for (std::size_t i = 1; i < curve_.points.size(); ++i) {
            const Curve::Point &before = curve_.points[i - 1], &here = curve_.points[i];
            if (here.x > before.x) continue;
            const auto shown = [&](const Rational& x) { return decimal(x / curve_.of.factor - curve_.of.offset, 9); };
            return e_.error(Id::value_out_of_range, here.span,
                            fmt::format("the points of curve '{}' must rise in '{}', but {} {} follows {} {}", curve_.name,
                                        curve_.variable, shown(here.x), curve_.of.written, shown(before.x), curve_.of.written),
                            {{before.span, "this is the point before"}});
        }
    }

    const Entry& e_;
    Curve& curve_;
};

}  // namespace

void check_rules(const Entry& e, Curve& curve) { CurveReader(e, curve).run(); }

}  // namespace dalembert
