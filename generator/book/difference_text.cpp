// SPDX-License-Identifier: GPL-3.0-or-later
#include "book/difference_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "form/random_points.hpp"
#include "symbolic/functions.hpp"
#include "symbolic/quotient.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

constexpr std::size_t most_signs = 4;
constexpr int compared_points = 200;
constexpr std::size_t most_terms = 1000;  ///< of a numerator over one denominator

/// What the difference is where signs have these values, +1 or -1; a sign that does not matter there is zero.
struct Piece {
    std::vector<int> signs;
    ex value;
    bool vanishes = false;
    bool has_value = true;  ///< false where no case holds

    bool differs(const Piece& other) const { return has_value != other.has_value || !value.is_equal(other.value); }
    bool fits(const Piece& other) const {
        for (std::size_t i = 0; i < signs.size(); ++i)
            if (signs[i] != 0 && signs[i] != other.signs[i]) return false;
        return true;
    }
};

class Pieces {
public:
    Pieces(const System& system, ex difference)
        : write_(system.symbols, Style::text), difference_(system.symbols.without_definitions(difference)) {
        for (auto part = difference_.preorder_begin(); part != difference_.preorder_end(); ++part)
            if (is_ex_the_function(*part, sign_of) &&
                std::none_of(inside_.begin(), inside_.end(), [&](const ex& known) { return known.is_equal(part->op(0)); }))
                inside_.push_back(part->op(0));
        // The order of GiNaC changes from run to run.
        std::sort(inside_.begin(), inside_.end(), [&](const ex& a, const ex& b) { return write_(a) < write_(b); });
        if (inside_.empty() || inside_.size() > most_signs) return;
        RandomPoints random(system);
        for (int i = 0; i < compared_points; ++i) look_at(system, random.next());
        shorten();
    }

    /// Empty where there is nothing to take apart, or where that was not possible.
    std::string text() const {
        std::vector<std::string> parts;
        bool is_zero_somewhere = false;
        for (const Piece& piece : found_) {
            if (!piece.has_value) continue;
            if (piece.value.is_zero()) is_zero_somewhere = true;
            else
                parts.push_back(std::all_of(piece.signs.begin(), piece.signs.end(), [](int s) { return s == 0; })
                                    ? write_(piece.value)
                                    : write_(piece.value) + " where " + condition(piece));
        }
        if (parts.empty()) return {};
        if (is_zero_somewhere) parts.emplace_back("0 elsewhere");
        return fmt::format("{}", fmt::join(parts, "; "));
    }

private:
    /// Signs that occur together do so at some point.
    void look_at(const System& system, const Point& point) {
        Piece piece;
        for (const ex& e : inside_) {
            const auto value = value_at(e, system.symbols, point, 30);
            if (!value || cln::zerop(*value)) return;
            piece.signs.push_back(cln::minusp(*value) ? -1 : 1);
        }
        // Also what signs alone do not show to be zero, as min(1, u) - u.
        const auto difference = value_at(difference_, system.symbols, point, 30);
        const bool vanishes = difference && cln::abs(*difference) < cln::expt(cln::cl_RA(10), -25);
        if (const auto known = std::find_if(found_.begin(), found_.end(), [&](const Piece& one) { return one.signs == piece.signs; });
            known != found_.end()) {
            known->vanishes = known->vanishes && vanishes;
            return;
        }
        piece.vanishes = vanishes;
        piece.has_value = difference.has_value();
        GiNaC::exmap known;
        for (std::size_t i = 0; piece.has_value && i < inside_.size(); ++i) {
            known[sign_of(inside_[i])] = piece.signs[i];
            for (const int turned : {1, -1}) known[magnitude((turned * inside_[i]).expand())] = piece.signs[i] * inside_[i];
        }
        if (piece.has_value) piece.value = difference_.subs(known, GiNaC::subs_options::no_pattern).expand();
        found_.push_back(std::move(piece));
    }

    /// Leaves out of each piece the signs that do not matter, and pieces that another holds for as well.
    void shorten() {
        for (Piece& piece : found_)
            if (piece.vanishes) piece.value = 0;
        std::sort(found_.begin(), found_.end(), [](const Piece& a, const Piece& b) { return a.signs < b.signs; });
        const std::vector<Piece> all = found_;
        std::vector<Piece> shortened;
        for (Piece piece : all) {
            if (std::any_of(shortened.begin(), shortened.end(), [&](const Piece& known) { return known.fits(piece); })) continue;
            for (int& sign : piece.signs) {
                const int kept = std::exchange(sign, 0);
                const bool matters =
                    std::any_of(all.begin(), all.end(), [&](const Piece& other) { return piece.fits(other) && piece.differs(other); });
                if (matters) sign = kept;
            }
            shortened.push_back(std::move(piece));
        }
        found_ = std::move(shortened);
    }

    /// "u > 1" of the sign of u - 1.
    std::string condition(const Piece& piece) const {
        std::vector<std::string> parts;
        for (std::size_t i = 0; i < inside_.size(); ++i) {
            if (piece.signs[i] == 0) continue;
            const ex e = inside_[i].expand();
            ex above = 0, below = 0, number = 0;
            const auto take = [&](const ex& term) {
                (GiNaC::is_a<GiNaC::numeric>(term) ? number : write_(term).starts_with('-') ? below : above) += term;
            };
            if (GiNaC::is_a<GiNaC::add>(e)) std::for_each(e.begin(), e.end(), take);
            else take(e);
            const bool turn = above.is_zero();  // "u < 1", not "1 > u"
            const bool is_more = (piece.signs[i] > 0) != turn;
            parts.push_back(fmt::format("{} {} {}", write_(turn ? ex(-below) : above), is_more ? '>' : '<',
                                        write_(turn ? number : ex(-below - number))));
        }
        return fmt::format("{}", fmt::join(parts, " and "));
    }

    Notation write_;
    ex difference_;
    std::vector<ex> inside_;
    std::vector<Piece> found_;
};

/// How many terms a product of sums may have.
std::size_t most_terms_of(const ex& product) {
    std::size_t terms = 1;
    const auto take = [&](const ex& factor) {
        const bool is_power = GiNaC::is_a<GiNaC::power>(factor) && factor.op(1).info(GiNaC::info_flags::posint);
        const ex base = is_power ? factor.op(0) : factor;
        if (!GiNaC::is_a<GiNaC::add>(base)) return;
        for (ex i = 0; i < (is_power ? factor.op(1) : ex(1)) && terms <= most_terms; i += 1) terms *= base.nops();
    };
    if (GiNaC::is_a<GiNaC::mul>(product)) std::for_each(product.begin(), product.end(), take);
    else take(product);
    return terms;
}

/// Whether a sum over one denominator can be written down: with many different denominators it grows as their product.
bool fits_one_denominator(const ex& sum) {
    std::size_t terms = sum.nops();
    GiNaC::exset denominators;
    for (const ex& term : sum)
        if (const ex below = term.denom(); terms <= most_terms && denominators.insert(below).second) terms *= most_terms_of(below);
    return terms <= most_terms;
}

}  // namespace

std::string difference_text(const System& system, const ex& difference, bool has_cases) {
    constexpr double most_expanded = 20'000;
    const Notation write(system.symbols, Style::text);
    if (terms_when_expanded(without_whole(difference)) > most_expanded) return write(difference);
    const ex sum = without_whole(difference).expand();
    const std::string pieces = has_cases ? Pieces(system, sum).text() : "";
    if (!pieces.empty()) return pieces;
    std::string shortest = write(sum);
    if (GiNaC::is_a<GiNaC::add>(sum) && fits_one_denominator(sum)) {
        const ex parts = sum.numer_denom();
        std::string fraction = write(quotient(parts.op(0).expand(), parts.op(1).expand()));
        if (fraction.size() < shortest.size()) shortest = std::move(fraction);
    }
    const std::string kept = write(difference);
    const auto divisions = [](const std::string& text) { return std::count(text.begin(), text.end(), '/'); };
    const bool is_simpler = shortest.size() < kept.size() && divisions(shortest) < divisions(kept);
    return is_simpler || 4 * shortest.size() < 3 * kept.size() ? shortest : kept;  // a few letters less are not worth another form
}

}  // namespace dalembert
