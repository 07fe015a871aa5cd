// SPDX-License-Identifier: GPL-3.0-or-later
#include "read/curve_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "language/dimension.hpp"
#include "text/data_file.hpp"
#include "text/nearest.hpp"

namespace dalembert {

namespace {

class CurveFile {
public:
    CurveFile(const Entry& e, Curve& curve) : e_(e), curve_(curve) {}

    bool read() {
        const std::string written = e_.text("file");
        if (written.empty()) {
            if (e_.excerpt("file"))
                e_.error(Id::wrong_type, e_.span_of("file"), fmt::format("the file of curve '{}' needs a name", curve_.name));
            return false;
        }
        const Span place = e_.span_of("file");
        const auto path = std::filesystem::path(place.source->name()).parent_path() / written;
        try {
            file_ = read_data_file(path);
        } catch (const Failure& failure) {
            const Diagnostic& first = failure.diagnostics().front();
            if (first.id != Id::unreadable_file) throw;
            throw Failure(Diagnostic{first.id, place,
                                     fmt::format("{}; the path of the points of curve '{}' begins beside the model file", first.message,
                                                 curve_.name)});
        }
        return take();
    }

private:
    using Names = std::vector<std::pair<std::string, Span>>;

    /// Of the variables and of the values.
    std::vector<Unit> declared() const {
        if (!curve_.grid) return {curve_.of, curve_.unit};
        return {curve_.of, curve_.grid->of, curve_.unit};
    }

    /// Nothing for what has been told.
    std::optional<Names> column_names() const {
        if (!e_.has("columns")) {
            Names names{{curve_.variable, e_.span_of("file")}};
            if (curve_.grid) names.emplace_back(curve_.grid->variable, e_.span_of("file"));
            names.emplace_back(curve_.name, e_.span_of("file"));
            return names;
        }
        Names columns = e_.names("columns");
        const std::size_t count = e_.length("columns"), needed = curve_.grid ? 3 : 2;
        if (!e_.is_list("columns") || columns.size() != count) return std::nullopt;
        std::string twice;
        for (std::size_t i = 0; i < count; ++i)
            for (std::size_t k = 0; k < i; ++k)
                if (columns[i].first == columns[k].first) twice = columns[i].first;
        if (count == needed && twice.empty()) return columns;
        const std::string of_variables =
            curve_.grid ? fmt::format("three columns, those of '{}' and '{}'", curve_.variable, curve_.grid->variable)
                        : fmt::format("two columns, that of '{}'", curve_.variable);
        throw Failure(Diagnostic{Id::wrong_arguments, e_.span_of("columns"),
                                 fmt::format("curve '{}' takes {} and that of the values; here {}", curve_.name, of_variables,
                                             count == needed ? fmt::format("{} are '{}'", needed == 2 ? "both" : "two", twice)
                                             : count == 0    ? "none is named"
                                             : count == 1    ? "one is named"
                                                             : fmt::format("{} are named", count))});
    }

    bool take() {
        const auto names = column_names();
        if (!names) return false;
        std::vector<const DataColumn*> found;
        for (std::size_t i = 0; i < names->size(); ++i) {
            found.push_back(file_.find((*names)[i].first));
            if (found.back() == nullptr)
                throw Failure(Diagnostic{
                    Id::unknown_name, (*names)[i].second,
                    fmt::format("the file has no column '{}', for the {} of curve '{}'; its columns are {}", (*names)[i].first,
                                i + 1 == names->size() ? "values" : "variable", curve_.name, quoted_list(file_.names()))});
        }
        std::vector<Unit> units = declared();
        for (std::size_t i = 0; i < units.size(); ++i) units[i] = unit_of(*found[i], units[i]);
        std::vector<std::vector<Rational>> lines;
        for (std::size_t row = 0; row < file_.lines.size(); ++row) {
            lines.emplace_back();
            for (std::size_t i = 0; i < found.size(); ++i) lines.back().push_back(in_si(number(file_, *found[i], row), units[i]));
        }
        if (curve_.grid) take_grid(lines);
        else
            for (std::size_t row = 0; row < lines.size(); ++row)
                curve_.points.push_back({lines[row][0], lines[row][1], file_.place(row)});
        return true;
    }

    /// A line for each pair of places, in any order.
    void take_grid(const std::vector<std::vector<Rational>>& lines) {
        Curve::Grid& grid = *curve_.grid;
        std::map<std::pair<Rational, Rational>, std::size_t> line_of;
        for (std::size_t row = 0; row < lines.size(); ++row) {
            const auto [known, is_new] = line_of.emplace(std::pair(lines[row][0], lines[row][1]), row);
            if (!is_new)
                throw Failure(Diagnostic{Id::doubly_defined, file_.place(row),
                                         fmt::format("curve '{}' has a second value at {}", curve_.name, place_of(lines[row])),
                                         {{file_.place(known->second), "this is the first"}}});
            grid.x.push_back(lines[row][0]);
            grid.y.push_back(lines[row][1]);
        }
        for (std::vector<Rational>* places : {&grid.x, &grid.y}) {
            std::sort(places->begin(), places->end());
            places->erase(std::unique(places->begin(), places->end()), places->end());
        }
        for (const Rational& x : grid.x) {
            grid.values.emplace_back();
            for (const Rational& y : grid.y) {
                const auto found = line_of.find({x, y});
                if (found == line_of.end())
                    throw Failure(Diagnostic{Id::missing_key, e_.span_of("file"),
                                             fmt::format("the file has no value of curve '{}' at {}; it needs one for each of the {} "
                                                         "places of '{}' at each of the {} places of '{}'",
                                                         curve_.name, place_of({x, y}), grid.x.size(), curve_.variable, grid.y.size(),
                                                         grid.variable)});
                grid.values.back().push_back(lines[found->second][2]);
            }
        }
    }

    std::string place_of(const std::vector<Rational>& line) const {
        return fmt::format("{} = {} and {} = {}", curve_.variable, written_in(line[0], curve_.of), curve_.grid->variable,
                           written_in(line[1], curve_.grid->of));
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

    const Entry& e_;
    Curve& curve_;
    DataFile file_;
};

}  // namespace

bool read_curve_file(const Entry& e, Curve& curve) { return CurveFile(e, curve).read(); }

}  // namespace dalembert
