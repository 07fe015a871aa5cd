// SPDX-License-Identifier: GPL-3.0-or-later
#include "graph/extract.hpp"

#include <algorithm>
#include <deque>
#include <map>
#include <unordered_map>

#include "graph/candidates.hpp"

namespace dalembert {

namespace {

using Letter = std::uint32_t;
using LetterList = std::vector<Letter>;
using CubeId = std::uint32_t;

/// A sum a + ratio*b without a common letter; a before b.
struct Divisor {
    LetterList a;
    LetterList b;
    Rational ratio;
    friend bool operator==(const Divisor&, const Divisor&) = default;
};

/// A product of two letters.
using Product = std::pair<Letter, Letter>;

/// Two cubes of one function that contain a divisor: `first` the a, `second` the b.
struct Occurrence {
    CubeId first;
    CubeId second;
};

std::uint64_t mixed(std::uint64_t hash, std::uint64_t value) {
    return (hash ^ (value + 0x9E3779B97F4A7C15ULL)) * 0xBF58476D1CE4E5B9ULL ^ (hash >> 31U);
}

/// Numbers coefficients and their ratios, so that the many comparisons need no exact arithmetic.
class Coefficients {
public:
    std::uint32_t number(const Rational& value) {
        const auto [known, is_new] = numbers_.emplace(value, static_cast<std::uint32_t>(values_.size()));
        if (is_new) values_.push_back(value);
        return known->second;
    }
    /// The number of y/x.
    std::uint32_t ratio(std::uint32_t x, std::uint32_t y) {
        const auto [known, is_new] = ratios_.emplace(static_cast<std::uint64_t>(x) << 32U | y, 0);
        if (is_new) known->second = number(values_[y] / values_[x]);
        return known->second;
    }

private:
    std::map<Rational, std::uint32_t> numbers_;
    std::vector<Rational> values_;
    std::unordered_map<std::uint64_t, std::uint32_t> ratios_;
};

constexpr std::size_t longest_sum = 150;

int multiplications(const LetterList& letters) { return letters.size() > 1 ? static_cast<int>(letters.size()) - 1 : 0; }

LetterList common(const LetterList& a, const LetterList& b) {
    LetterList result;
    std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(result));
    return result;
}

LetterList difference(const LetterList& a, const LetterList& b) {
    LetterList result;
    std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(result));
    return result;
}

LetterList with(LetterList letters, Letter letter) {
    letters.insert(std::upper_bound(letters.begin(), letters.end(), letter), letter);
    return letters;
}

class Extraction {
public:
    explicit Extraction(Network& network) : network_(network), members_(network.functions.size()) {
        for (std::size_t f = 0; f < network.functions.size(); ++f) {
            const bool in_sums = network.functions[f].size() <= longest_sum;
            for (const Cube& cube : network.functions[f]) add_cube(f, cube, in_sums);
        }
    }

    void run() {
        while (true) {
            const auto sum = sums_.best([&](Sum& s) { return usable(s).saved; });
            const auto product = products_.best([&](Pair& p) { return users(p); });
            if (!sum && !product) break;
            // Sums first where both save as much: a product inside them is found again afterwards.
            if (sum && (!product || sums_[*sum].queued >= products_[*product].queued))
                apply_sum(*sum);
            else
                apply_product(*product);
        }
        for (std::size_t f = 0; f < members_.size(); ++f) {
            network_.functions[f].clear();
            for (const CubeId c : members_[f]) network_.functions[f].push_back(cubes_[c].cube);
        }
    }

private:
    using Sum = Candidate<Occurrence>;
    using Pair = Candidate<CubeId>;

    struct Entry {
        Cube cube;
        std::uint32_t coefficient;
        std::size_t function;
        bool alive = true;
    };
    struct Usable {
        int saved;
        std::vector<Occurrence> places;
    };

    void add_cube(std::size_t function, Cube cube, bool in_sums = true, bool in_products = true) {
        const auto id = static_cast<CubeId>(cubes_.size());
        const std::uint32_t coefficient = coefficients_.number(cube.coefficient);
        cubes_.push_back({std::move(cube), coefficient, function});
        // The pairs of a sum grow with the square of its length; in a very long one only products are looked for.
        if (in_sums && members_[function].size() <= longest_sum)
            for (const CubeId other : members_[function]) note_sum(other, id);
        members_[function].push_back(id);
        const LetterList& letters = cubes_[id].cube.letters;
        for (std::size_t i = 0; in_products && i < letters.size(); ++i)
            for (std::size_t j = i + 1; j < letters.size(); ++j)
                products_.note(static_cast<std::uint64_t>(letters[i]) << 32U | letters[j], id,  // no mere fingerprint, but the pair itself
                               [](const Pair& pair) { return static_cast<int>(pair.places.size()) - (pair.letter ? 0 : 1); });
    }

    void remove_cube(CubeId id) {
        cubes_[id].alive = false;
        std::erase(members_[cubes_[id].function], id);
    }

    /// Fingerprint of the divisor of two cubes in one pass over their letters. The part that has the smaller first letter is the a.
    void note_sum(CubeId id_x, CubeId id_y) {
        const LetterList &x = cubes_[id_x].cube.letters, &y = cubes_[id_y].cube.letters;
        std::uint64_t only_x = 1;
        std::uint64_t only_y = 1;
        int count_x = 0;
        int count_y = 0;
        bool x_is_first = false;
        for (std::size_t i = 0, j = 0; i < x.size() || j < y.size();) {
            if (j == y.size() || (i < x.size() && x[i] < y[j])) {
                if (count_x + count_y == 0) x_is_first = true;
                only_x = mixed(only_x, x[i++]);
                ++count_x;
            } else if (i == x.size() || y[j] < x[i]) {
                only_y = mixed(only_y, y[j++]);
                ++count_y;
            } else {
                ++i;
                ++j;
            }
        }
        if (count_x == 0) x_is_first = true;
        if (count_y == 0) x_is_first = false;
        const Occurrence occurrence = x_is_first ? Occurrence{id_x, id_y} : Occurrence{id_y, id_x};
        const std::uint32_t ratio = coefficients_.ratio(cubes_[occurrence.first].coefficient, cubes_[occurrence.second].coefficient);
        const std::uint64_t fingerprint = mixed(x_is_first ? mixed(only_x, only_y) : mixed(only_y, only_x), ratio);
        // No two cubes have more than a handful of letters in common, so the guess is not too low.
        const int each = std::max(count_x - 1, 0) + std::max(count_y - 1, 0) + 7;
        sums_.note(fingerprint, occurrence, [each](const Sum& sum) { return static_cast<int>(sum.places.size()) * each; });
    }

    Divisor divisor_at(const Occurrence& o) const {
        const Cube &x = cubes_[o.first].cube, &y = cubes_[o.second].cube;
        const LetterList shared = common(x.letters, y.letters);
        return {difference(x.letters, shared), difference(y.letters, shared), y.coefficient / x.coefficient};
    }

    int saved_by(const Occurrence& occurrence) const {
        const LetterList &x = cubes_[occurrence.first].cube.letters, &y = cubes_[occurrence.second].cube.letters;
        return multiplications(x) + multiplications(y) + 1 - static_cast<int>(common(x, y).size());
    }

    /// The occurrences that are still there and do not share cubes, with the operations they save.
    Usable usable(Sum& sum) const {
        std::erase_if(sum.places, [&](const Occurrence& o) { return !cubes_[o.first].alive || !cubes_[o.second].alive; });
        if (sum.places.size() < (sum.letter ? 1U : 2U)) return {0, {}};
        std::vector<CubeId> taken;
        const auto is_taken = [&](CubeId id) { return std::find(taken.begin(), taken.end(), id) != taken.end(); };
        Usable result{0, {}};
        for (const Occurrence& o : sum.places) {
            if (is_taken(o.first) || is_taken(o.second)) continue;
            taken.insert(taken.end(), {o.first, o.second});
            result.places.push_back(o);
            result.saved += saved_by(o);
        }
        if (sum.letter) return result;
        const Divisor divisor = divisor_at(result.places.front());
        result.saved -= multiplications(divisor.a) + multiplications(divisor.b) + 1;
        if (result.places.size() < 2) result.saved = 0;
        return result;
    }

    void apply_sum(std::size_t id) {
        Sum& sum = sums_[id];
        const std::vector<Occurrence> places = usable(sum).places;
        sums_.take_out(id);
        if (!sum.letter) {
            const Divisor divisor = divisor_at(places.front());
            sum.letter = new_function({{Rational(1), divisor.a}, {divisor.ratio, divisor.b}});
            divisors_.emplace(*sum.letter, divisor);
        }
        const Letter letter = *sum.letter;
        for (const Occurrence& o : places) {
            if (!(divisor_at(o) == divisors_.at(letter))) continue;  // equal fingerprints of different sums
            const std::size_t function = cubes_[o.first].function;
            Cube cube{cubes_[o.first].cube.coefficient, with(common(cubes_[o.first].cube.letters, cubes_[o.second].cube.letters), letter)};
            remove_cube(o.first);
            remove_cube(o.second);
            add_cube(function, std::move(cube));
        }
    }

    static int count(const LetterList& letters, const Product& product) {
        const auto times = [&](Letter l) { return static_cast<int>(std::count(letters.begin(), letters.end(), l)); };
        return product.first == product.second ? times(product.first) / 2 : std::min(times(product.first), times(product.second));
    }

    /// What computing the product once saves; forgets the places that are gone.
    int users(Pair& pair) const {
        std::sort(pair.places.begin(), pair.places.end());
        pair.places.erase(std::unique(pair.places.begin(), pair.places.end()), pair.places.end());
        std::erase_if(pair.places, [&](CubeId id) { return !cubes_[id].alive; });
        return static_cast<int>(pair.places.size()) - (pair.letter ? 0 : 1);
    }

    void apply_product(std::size_t id) {
        Pair& pair = products_[id];
        const std::vector<CubeId> places = pair.places;
        products_.take_out(id);
        const Product product{static_cast<Letter>(pair.fingerprint >> 32U), static_cast<Letter>(pair.fingerprint)};
        if (!pair.letter) pair.letter = new_function({{Rational(1), {product.first, product.second}}});
        const Letter letter = *pair.letter;
        for (const CubeId place : places) {
            const std::size_t function = cubes_[place].function;
            Cube cube = cubes_[place].cube;
            for (int n = count(cube.letters, product); n > 0; --n) {
                cube.letters.erase(std::find(cube.letters.begin(), cube.letters.end(), product.first));
                cube.letters.erase(std::find(cube.letters.begin(), cube.letters.end(), product.second));
                cube.letters = with(std::move(cube.letters), letter);
            }
            remove_cube(place);
            add_cube(function, std::move(cube));
        }
    }

    Letter new_function(const CubeSum& sum) {
        const auto letter = static_cast<Letter>(network_.first_letter + network_.functions.size());
        network_.functions.emplace_back();
        members_.emplace_back();
        // The function is that sum or product itself, so it is not counted as one more place where it occurs.
        for (const Cube& cube : sum) add_cube(network_.functions.size() - 1, cube, false, sum.size() > 1);
        return letter;
    }

    Network& network_;
    std::deque<Entry> cubes_;
    std::vector<std::vector<CubeId>> members_;  ///< cubes of each function
    Coefficients coefficients_;
    Candidates<Occurrence> sums_;
    Candidates<CubeId> products_;
    std::map<Letter, Divisor> divisors_;
};

}  // namespace

void extract(Network& network) { Extraction(network).run(); }

}  // namespace dalembert
