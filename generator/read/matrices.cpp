// SPDX-License-Identifier: GPL-3.0-or-later
#include "read/matrices.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "elements/runs.hpp"
#include "language/vocabulary.hpp"
#include "read/cases.hpp"
#include "read/matrix_algebra.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

namespace {

using Kind = Expression::Kind;

constexpr std::size_t most_entries = 400;

bool is_call(const Expression& e, std::string_view name) { return e.kind == Kind::call && e.name == name; }

/// position[bob], where position[bob, 1] is a number.
bool is_whole_vector(const Expression& e) {
    const QuantitySpec* quantity = e.kind == Kind::name ? find_quantity(e.name) : nullptr;
    return quantity != nullptr && quantity->subscript == Subscript::body_and_axis && e.children.size() == 1;
}

class Matrices {
public:
    /// Letters that stand for matrices, also by way of others.
    explicit Matrices(const std::vector<PrintedLetter>& letters) : letters_(letters) {}

    bool is_needed(const Expression& e) {
        bool needed = false;
        for_each(e, [&](const Expression& part) {
            const bool is_matrix = is_call(part, "matrix") || is_call(part, "vector") || is_call(part, "cross") || is_call(part, "diag") ||
                                   is_whole_vector(part);
            needed = needed || is_matrix || (part.kind == Kind::name && stands_for_matrix(part.name));
        });
        return needed;
    }

    bool stands_for_matrix(const std::string& name) {
        const auto found = std::find_if(letters_.begin(), letters_.end(), [&](const PrintedLetter& l) { return l.name == name; });
        if (found == letters_.end()) return false;
        const auto [known, is_new] = is_matrix_.emplace(name, false);
        if (is_new && is_needed(*found->value)) {
            values_[name] = value(found->value);
            is_matrix_[name] = !values_[name].is_number();
        }
        return is_matrix_[name];
    }

    MatrixExpression value(const ExpressionPtr& e) {
        switch (e->kind) {
            case Kind::number: return number(e);
            case Kind::name: return name(e);
            case Kind::call: return call(e);
            case Kind::sum: return each(e, {2});
            case Kind::negate: return each(e, {0});
            case Kind::add:
            case Kind::subtract: return sum(e, value(e->children[0]), value(e->children[1]));
            case Kind::multiply: return matrix_product(*e, value(e->children[0]), value(e->children[1]));
            case Kind::divide: return quotient(*e, value(e->children[0]), value(e->children[1]));
            case Kind::power: break;
        }
        const MatrixExpression base = value(e->children[0]);
        if (base.is_number()) return number(with_parts(*e, {base.entries[0], scalar(e->children[1])}));
        return power(*e, base);
    }

private:
    static MatrixExpression number(ExpressionPtr e) { return {1, 1, {std::move(e)}}; }

    ExpressionPtr scalar(const ExpressionPtr& e) {
        const MatrixExpression m = value(e);
        if (m.is_number()) return m.entries[0];
        fail(Id::wrong_arguments, e->span, fmt::format("'{}' is a {} matrix where a number is expected", e->written(), size_of(m)));
    }

    MatrixExpression name(const ExpressionPtr& e) {
        if (stands_for_matrix(e->name)) return values_.at(e->name);
        if (!is_whole_vector(*e)) return number(e);
        MatrixExpression result{3, 1, {}};
        for (int axis = 1; axis <= 3; ++axis) result.entries.push_back(with_parts(*e, {e->children[0], make_number(axis, e->span)}));
        return result;
    }

    /// A node whose operands at `places` may be matrices, one of them at most: entry by entry.
    MatrixExpression each(const ExpressionPtr& e, std::vector<std::size_t> places) {
        std::vector<ExpressionPtr> children = e->children;
        MatrixExpression shape = number(e);
        std::size_t varying = places.front();
        for (std::size_t i = 0; i < children.size(); ++i) {
            if (std::find(places.begin(), places.end(), i) == places.end()) continue;
            const MatrixExpression part = value(children[i]);
            if (part.is_number()) {
                children[i] = part.entries[0];
                continue;
            }
            shape = part;
            varying = i;
        }
        if (shape.is_number()) return number(with_parts(*e, children));
        for (ExpressionPtr& entry : shape.entries) {
            children[varying] = entry;
            entry = with_parts(*e, children);
        }
        return shape;
    }

    MatrixExpression sum(const ExpressionPtr& e, const MatrixExpression& a, const MatrixExpression& b) {
        const auto is_zero_number = [](const MatrixExpression& m) {
            return m.is_number() && m.entries[0]->kind == Kind::number && is_zero(m.entries[0]->value);
        };
        if (is_zero_number(b)) return a;
        if (a.rows != b.rows || a.columns != b.columns)
            fail(Id::size_mismatch, e->span,
                 fmt::format("'{}' is {} and '{}' is {}; the two must agree", e->children[0]->written(), size_of(a),
                             e->children[1]->written(), size_of(b)));
        MatrixExpression result{a.rows, a.columns, {}};
        for (std::size_t i = 0; i < a.entries.size(); ++i) result.entries.push_back(with_parts(*e, {a.entries[i], b.entries[i]}));
        return result;
    }

    /// Of a square matrix and a whole number, but zero.
    static MatrixExpression power(const Expression& e, const MatrixExpression& base) {
        constexpr int largest = 9;
        const bool is_negative = e.children[1]->kind == Kind::negate;
        const Expression& digits = is_negative ? *e.children[1]->children[0] : *e.children[1];
        const auto exponent = digits.kind == Kind::number ? to_int(digits.value) : std::nullopt;
        if (!exponent || *exponent == 0 || std::abs(*exponent) > largest || base.rows != base.columns)
            fail(Id::wrong_arguments, e.span,
                 fmt::format("'{}' is a power of a {} matrix; only square matrices have powers, from -{} to {} and not 0", e.written(),
                             size_of(base), largest, largest));
        const int signed_exponent = is_negative ? -*exponent : *exponent;
        return matrix_power(e, signed_exponent < 0 ? square(e, base) : base, signed_exponent);
    }

    MatrixExpression quotient(const Expression& e, const MatrixExpression& a, const MatrixExpression& b) {
        if (!b.is_number())
            fail(Id::wrong_arguments, e.span, fmt::format("'{}' divides by a {} matrix; write its inverse", e.written(), size_of(b)));
        MatrixExpression result = a;
        for (ExpressionPtr& entry : result.entries) entry = with_parts(e, {entry, b.entries[0]});
        return result;
    }

    MatrixExpression call(const ExpressionPtr& e) {
        const auto argument = [&](std::size_t i) { return value(e->children.at(i)); };
        const auto takes = [&](std::size_t count) {
            if (e->children.size() != count)
                fail(Id::wrong_arguments, e->span,
                     fmt::format("'{}' takes {} argument{}, here it has {}", e->name, count, count == 1 ? "" : "s", e->children.size()));
        };
        if (e->name == "quantity") return number(e);
        if (e->name == "matrix") return rows(*e);
        if (e->name == "vector") {
            MatrixExpression result{e->children.size(), 1, {}};
            for (const ExpressionPtr& child : e->children) result.entries.push_back(scalar(child));
            if (e->children.empty()) fail(Id::wrong_arguments, e->span, "a vector has entries, as in 'vector(x, y, z)'");
            return result;
        }
        if (e->name == "transpose") return takes(1), transposed(argument(0));
        if (e->name == "trace") return takes(1), number(trace_of(*e, square(*e, argument(0))));
        if (e->name == "diag") return diagonal(*e);
        if (e->name == "det") return takes(1), number(determinant_of(*e, square(*e, argument(0))));
        if (e->name == "inverse") return takes(1), inverse_of(*e, square(*e, argument(0)));
        if (e->name == "cross") return takes(2), cross_product(*e, argument(0), argument(1));
        if (e->name == "abs" && e->children.size() == 1) return magnitude(*e, argument(0));
        if (e->name == "dot" || e->name == "ddot" || e->name == "integral" || e->name == "limit" || e->name == "at") return each(e, {0});
        if (e->name == "diff" && e->children.size() == 2) return slope(*e, argument(0), argument(1));
        std::vector<ExpressionPtr> children;
        for (const ExpressionPtr& child : e->children) children.push_back(scalar(child));
        return number(with_parts(*e, std::move(children)));
    }

    /// |R| is the determinant of a matrix, and not the length of a column.
    static MatrixExpression magnitude(const Expression& e, const MatrixExpression& m) {
        if (m.is_number()) return number(with_parts(e, {m.entries[0]}));
        if (m.columns == 1 || m.rows == 1)
            fail(Id::wrong_arguments, e.span,
                 fmt::format("'{}' is the magnitude of a {} vector; write '\\|', or sqrt(transpose(v)*v)", e.written(), size_of(m)));
        return number(determinant_of(e, square(e, m)));
    }

    MatrixExpression rows(const Expression& e) {
        MatrixExpression result{e.children.size(), 0, {}};
        for (const ExpressionPtr& row : e.children) {
            if (!is_call(*row, "row") || row->children.empty() || (result.columns != 0 && row->children.size() != result.columns))
                fail(Id::wrong_arguments, row->span, "a matrix is made of rows of one length, as in 'matrix(row(a, b), row(c, d))'");
            result.columns = row->children.size();
            for (const ExpressionPtr& entry : row->children) result.entries.push_back(scalar(entry));
        }
        if (result.entries.empty() || result.entries.size() > most_entries)
            fail(Id::wrong_arguments, e.span, fmt::format("a matrix has 1 to {} entries", most_entries));
        return result;
    }

    static MatrixExpression square(const Expression& e, MatrixExpression m) {
        constexpr std::size_t largest = 5;
        if (m.rows != m.columns || m.rows > largest)
            fail(Id::wrong_arguments, e.span,
                 fmt::format("'{}' takes a square matrix of at most {} rows, here the matrix is {}", e.name, largest, size_of(m)));
        return m;
    }

    /// diag(a, b, c), also with brackets that LaTeX reads as a row.
    MatrixExpression diagonal(const Expression& e) {
        const bool is_row = e.children.size() == 1 && is_call(*e.children[0], "row");
        const std::vector<ExpressionPtr>& entries = is_row ? e.children[0]->children : e.children;
        if (entries.empty() || entries.size() * entries.size() > most_entries)
            fail(Id::wrong_arguments, e.span, "a diagonal has entries, as in 'diag(a, b, c)'");
        MatrixExpression result{entries.size(), entries.size(), {}};
        for (std::size_t i = 0; i < entries.size(); ++i)
            for (std::size_t k = 0; k < entries.size(); ++k) result.entries.push_back(i == k ? scalar(entries[i]) : make_number(0, e.span));
        return result;
    }

    /// A number by a vector is a row, a column by a vector the matrix of its derivatives.
    static MatrixExpression slope(const Expression& e, const MatrixExpression& function, const MatrixExpression& by) {
        if (function.columns != 1 && !by.is_number())
            fail(Id::wrong_arguments, e.span, fmt::format("'{}' differentiates a {} matrix by a vector", e.written(), size_of(function)));
        MatrixExpression result{function.rows, function.columns * by.entries.size(), {}};
        for (const ExpressionPtr& entry : function.entries)
            for (const ExpressionPtr& variable : by.entries) result.entries.push_back(with_parts(e, {entry, variable}));
        return result;
    }

    const std::vector<PrintedLetter>& letters_;
    std::map<std::string, bool> is_matrix_;
    std::map<std::string, MatrixExpression> values_;
};

/// Where the entry k stands.
std::string place_of(std::size_t k, const MatrixExpression& m) {
    if (m.is_number()) return {};
    if (m.columns == 1) return fmt::format("row {}", k + 1);
    return m.rows == 1 ? fmt::format("column {}", k + 1) : fmt::format("row {}, column {}", k / m.columns + 1, k % m.columns + 1);
}

/// What a row has of the third axis of a body: position[bob, 3]; null where it has none.
const Expression* third_axis(const Expression& row) {
    const Expression* found = nullptr;
    for_each(row, [&](const Expression& e) {
        const QuantitySpec* quantity = e.kind == Kind::name ? find_quantity(e.name) : nullptr;
        const bool is_of_axis = quantity != nullptr && quantity->subscript == Subscript::body_and_axis && e.children.size() == 2;
        if (is_of_axis && e.children[1]->kind == Kind::number && e.children[1]->value == 3) found = &e;
    });
    return found;
}

/// The equations of the entries. A number zero is a matrix of zeros. In the plane a vector of a body may be printed with two rows: then the
/// third one has to be zero.
void take_apart(const Equation& equation, std::vector<MatrixExpression> sides, std::vector<Equation>& to) {
    const auto largest =
        *std::max_element(sides.begin(), sides.end(), [](const auto& a, const auto& b) { return a.entries.size() < b.entries.size(); });
    std::string left_out;
    for (std::size_t i = 0; i < sides.size(); ++i) {
        MatrixExpression& side = sides[i];
        const bool is_zero_number = side.is_number() && side.entries[0]->kind == Kind::number && is_zero(side.entries[0]->value);
        if (is_zero_number || (side.rows == largest.rows && side.columns == largest.columns)) continue;
        std::string sentence = fmt::format("'{}' is {}, but another side of the equation is {}", equation.sides[i]->written(),
                                           size_of(side), size_of(largest));
        const bool has_two_of_three = side.rows == 2 && side.columns == 1 && largest.rows == 3 && largest.columns == 1;
        const Expression* third = has_two_of_three ? third_axis(*largest.entries[2]) : nullptr;
        if (third == nullptr) fail(Id::size_mismatch, equation.sides[i]->span, std::move(sentence));
        side.rows = 3;
        side.entries.push_back(make_number(0, equation.sides[i]->span));
        left_out = fmt::format("{2}, of which the third row is not zero; for two rows write vector({0}[{1}, 1], {0}[{1}, 2])", third->name,
                               third->children[0]->name, sentence);
    }
    for (std::size_t k = 0; k < largest.entries.size(); ++k) {
        Equation one{{}, equation.span, place_of(k, largest), k == 2 ? left_out : "", equation.is_near_zero};
        for (const MatrixExpression& side : sides) one.sides.push_back(side.entries.size() == 1 ? side.entries[0] : side.entries[k]);
        to.push_back(std::move(one));
    }
}

}  // namespace

std::vector<Equation> without_matrices(std::vector<Equation> equations, std::vector<PrintedLetter>& letters) {
    for (Equation& equation : equations)
        for (ExpressionPtr& side : equation.sides) side = without_cases(side);
    const std::vector<PrintedLetter> all = letters;
    Matrices matrices(all);
    std::vector<Equation> result;
    for (const Equation& equation : equations) {
        if (std::none_of(equation.sides.begin(), equation.sides.end(),
                         [&](const ExpressionPtr& side) { return matrices.is_needed(*side); })) {
            result.push_back(equation);
            continue;
        }
        std::vector<MatrixExpression> sides;
        for (const ExpressionPtr& side : equation.sides) sides.push_back(matrices.value(side));
        take_apart(equation, sides, result);
    }
    letters.clear();
    for (const PrintedLetter& letter : all) {
        if (matrices.stands_for_matrix(letter.name)) continue;
        letters.push_back(letter);
        if (matrices.is_needed(*letter.value)) letters.back().value = matrices.value(letter.value).entries[0];
    }
    return result;
}

void take_matrices_apart(PrintedEquation& printed) {
    printed.letters = printed.shown_letters;
    try {
        printed.equations = without_matrices(printed.shown, printed.letters);
    } catch (const Failure& failure) {
        if (failure.diagnostics().front().id != Id::size_mismatch) throw;
        printed.sizes = failure.diagnostics().front().message;
        printed.equations.clear();
        printed.letters.clear();
    }
}

}  // namespace dalembert
