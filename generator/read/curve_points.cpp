// SPDX-License-Identifier: GPL-3.0-or-later
// The variables and points of a curve: of the model file, or of a CSV file beside it.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "language/dimension.hpp"
#include "read/curve_file.hpp"
#include "read/rules.hpp"

namespace dalembert {

namespace {

Excerpt part_of(const Excerpt& whole, std::size_t begin, std::size_t end) {
    while (begin < end && whole.text[begin] == ' ') ++begin;
    const auto at = [&](std::size_t i) { return whole.offsets.begin() + static_cast<std::ptrdiff_t>(i); };
    return {whole.source, whole.text.substr(begin, end - begin), {at(begin), at(end) + 1}};
}

/// As it was written, without the unit.
std::string shown(const Rational& x, const Unit& unit) { return decimal(x / unit.factor - unit.offset, 9); }

class CurveReader {
public:
    CurveReader(const Entry& e, Curve& curve) : e_(e), curve_(curve) {}

    void run() {
        if (const auto text = e_.excerpt("of"); text && !read_variables(*text)) return;
        const char* own = curve_.grid ? "grid" : "points";
        if (const char* other = curve_.grid ? "points" : "grid"; e_.has(other))
            return e_.error(Id::unknown_key, e_.span_of(other),
                            fmt::format("curve '{}({})' has {}; it takes {}", curve_.name, arguments_of(curve_),
                                        curve_.grid ? "two variables" : "one variable", curve_.grid ? "a grid" : "points"));
        if (e_.has(own) && e_.has("file"))
            return e_.error(Id::doubly_defined, e_.span_of("file"),
                            fmt::format("curve '{}' has {} and a file; one of them says what the other does", curve_.name, noun()));
        if (!e_.has(own) && !e_.has("file"))
            return e_.error(Id::missing_key, e_.span(), fmt::format("curve '{}' needs {} or a file with points", curve_.name, noun()));
        if (e_.has("columns") && !e_.has("file"))
            e_.error(Id::unknown_key, e_.span_of("columns"),
                     fmt::format("curve '{}' has {} and no file, of which the columns could be", curve_.name, noun()));
        if (e_.has("file")) return read_file();
        if (curve_.grid ? read_grid() : read_points()) check();
    }

private:
    const char* noun() const { return curve_.grid ? "a grid" : "points"; }

    /// "x [mm]", or "n [rpm], p [bar]". Whether they can be read.
    bool read_variables(const Excerpt& text) {
        const std::size_t first_end = text.text.find(']'), comma = text.text.find(',', first_end == std::string::npos ? 0 : first_end);
        if (comma == std::string::npos) return read_variable(text, curve_.variable, curve_.of);
        curve_.grid.emplace();
        const bool is_first = read_variable(part_of(text, 0, comma), curve_.variable, curve_.of);
        const Excerpt second = part_of(text, comma + 1, text.text.size());
        if (second.text.find("],") != std::string::npos) {
            e_.error(Id::syntax, text.whole(), fmt::format("a curve has one or two variables, but '{}' are more", text.text));
            return false;
        }
        if (!read_variable(second, curve_.grid->variable, curve_.grid->of) || !is_first) return false;
        if (curve_.grid->variable != curve_.variable) return true;
        e_.error(Id::doubly_defined, second.whole(), fmt::format("both variables of curve '{}' are '{}'", curve_.name, curve_.variable));
        return false;
    }

    bool read_variable(const Excerpt& text, std::string& variable, Unit& of) const {
        const std::size_t open = text.text.find('['), close = text.text.rfind(']');
        const std::string after = close == std::string::npos ? "" : text.text.substr(close + 1);
        std::size_t end = std::min(open, text.text.size());
        while (end > 0 && text.text[end - 1] == ' ') --end;
        variable = text.text.substr(0, end);
        const auto is_letter = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
        const bool is_name = !variable.empty() && std::isdigit(static_cast<unsigned char>(variable[0])) == 0 &&
                             std::all_of(variable.begin(), variable.end(), is_letter);
        if (!is_name || open == std::string::npos || close == std::string::npos || close < open ||
            after.find_first_not_of(' ') != std::string::npos) {
            e_.error(Id::syntax, text.whole(),
                     fmt::format("'{}' is not a variable with its unit, as in 'x [mm]' or 'x [1]'", text.text));
            return false;
        }
        try {
            of = parse_unit(part_of(text, open + 1, close));
        } catch (const Failure& failure) {
            for (const Diagnostic& d : failure.diagnostics()) e_.error(d.id, d.span, d.message, d.notes);
            return false;
        }
        return true;
    }

    /// Nothing for what has been told.
    std::optional<Rational> number(const ExpressionPtr& value) const {
        if (value && value->kind == Expression::Kind::number && value->name.empty()) return value->value;
        if (value)
            e_.error(Id::wrong_type, value->span,
                     fmt::format("'{}' is not a number; {} of curve '{}' {} numbers in '{}'{} and '{}'", value->written(),
                                 curve_.grid ? "the grid" : "points", curve_.name, curve_.grid ? "has" : "are", curve_.of.written,
                                 curve_.grid ? ", '" + curve_.grid->of.written + "'" : "", curve_.unit.written));
        return std::nullopt;
    }

    bool read_points() {
        bool all_there = true;
        const auto points = e_.points("points");
        for (const auto& [x, y] : points) {
            const auto at = number(x), value = number(y);
            all_there = all_there && at && value;
            if (x && y)
                curve_.points.push_back(
                    {in_si(at.value_or(0), curve_.of), in_si(value.value_or(0), curve_.unit), cover(x->span, y->span)});
        }
        // What was no pair has been told.
        return all_there && e_.is_list("points") && points.size() == e_.length("points") && curve_.points.size() == points.size();
    }

    /// The first row has the places of the second variable; each other row a place of the first and the values there.
    bool read_grid() {
        Curve::Grid& grid = *curve_.grid;
        const auto rows = e_.grid("grid");
        bool all_there = e_.is_list("grid");
        for (std::size_t i = 0; i < rows.size(); ++i) {
            std::vector<Rational> numbers;
            for (const ExpressionPtr& entry : rows[i]) {
                const auto value = number(entry);
                all_there = all_there && value;
                const bool is_place = i == 0 || numbers.empty();
                const Unit& unit = i == 0 ? grid.of : is_place ? curve_.of : curve_.unit;
                const Rational si = in_si(value.value_or(0), unit);
                if (entry && is_place) (i == 0 ? columns_ : rows_).push_back(entry->span);
                numbers.push_back(si);
            }
            if (i > 0 && all_there && numbers.size() != grid.y.size() + 1) {
                e_.error(Id::wrong_arguments, rows[i].empty() ? e_.span_of("grid") : cover(rows[i].front()->span, rows[i].back()->span),
                         fmt::format("row {} of the grid of curve '{}' has {} numbers, but needs {}: a place of '{}', and a value for each "
                                     "of the {} places of '{}' in the first row",
                                     i + 1, curve_.name, numbers.size(), grid.y.size() + 1, curve_.variable, grid.y.size(), grid.variable));
                return false;
            }
            if (!all_there) continue;
            if (i == 0) {
                grid.y = numbers;
                continue;
            }
            grid.x.push_back(numbers.front());
            grid.values.emplace_back(numbers.begin() + 1, numbers.end());
        }
        return all_there;
    }

    void read_file() {
        try {
            if (!read_curve_file(e_, curve_)) return;
        } catch (const Failure& failure) {
            for (const Diagnostic& d : failure.diagnostics()) e_.error(d.id, d.span, d.message, d.notes);
            return;
        }
        check();
    }

    void check() const {
        if (!curve_.grid) {
            std::vector<Rational> places;
            std::vector<Span> spans;
            for (const Curve::Point& point : curve_.points) {
                places.push_back(point.x);
                spans.push_back(point.span);
            }
            if (are_enough(places.size(), "point", curve_.variable)) check_rise(places, spans, curve_.variable, curve_.of);
            return;
        }
        const Curve::Grid& grid = *curve_.grid;
        if (!are_enough(grid.x.size(), "place", curve_.variable) || !are_enough(grid.y.size(), "place", grid.variable)) return;
        if (check_rise(grid.x, rows_, curve_.variable, curve_.of)) check_rise(grid.y, columns_, grid.variable, grid.of);
    }

    bool are_enough(std::size_t count, const char* what, const std::string& variable) const {
        if (count >= 2) return true;
        const char* own = curve_.grid ? "grid" : "points";
        e_.error(Id::value_out_of_range, e_.span_of(e_.has(own) ? own : "file"),
                 fmt::format("curve '{}' has {} {}{}, but needs two or more", curve_.name, count == 0 ? "no" : "one", what,
                             curve_.grid ? " of '" + variable + "'" : ""));
        return false;
    }

    /// Whether they do. Spans are those of the places, where there are some: those of a file are sorted.
    bool check_rise(const std::vector<Rational>& places, const std::vector<Span>& spans, const std::string& variable,
                    const Unit& unit) const {
        for (std::size_t i = 1; i < places.size(); ++i) {
            if (places[i] > places[i - 1]) continue;
            e_.error(Id::value_out_of_range, spans.at(i),
                     fmt::format("the points of curve '{}' must rise in '{}', but {} {} follows {} {}", curve_.name, variable,
                                 shown(places[i], unit), unit.written, shown(places[i - 1], unit), unit.written),
                     {{spans.at(i - 1), "this is the point before"}});
            return false;
        }
        return true;
    }

    const Entry& e_;
    Curve& curve_;
    std::vector<Span> rows_, columns_;  ///< of the places of a grid
};

}  // namespace

void check_rules(const Entry& e, Curve& curve) { CurveReader(e, curve).run(); }

}  // namespace dalembert
