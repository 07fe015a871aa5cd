// SPDX-License-Identifier: GPL-3.0-or-later
// A function of a shared library with the calling convention of CasADi: its signature, checked, and its values. It knows that convention
// alone.
#pragma once

#include <dlfcn.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

[[noreturn]] inline void fail(const std::string& what) {
    std::printf("%s\n", what.c_str());
    std::exit(1);
}
inline void require(bool holds, const std::string& what) {
    if (!holds) fail(what);
}

using Vector = std::vector<double>;

inline void* loaded(const char* file) {
    void* const library = dlopen(file, RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) fail(dlerror());
    return library;
}

/// A matrix whose entries are stored by columns, or all.
struct Pattern {
    std::size_t rows = 0, columns = 0;
    std::vector<std::size_t> starts, indices;

    template <class Int>
    static Pattern read(const Int* given, const std::string& of) {
        require(given != nullptr, of + ": no pattern");
        require(given[0] >= 0 && given[1] >= 0, of + ": sizes of the pattern");
        Pattern p{static_cast<std::size_t>(given[0]), static_cast<std::size_t>(given[1]), {0}, {}};
        if (p.columns > 0 && given[2] == 1) {  // all of them
            for (std::size_t c = 0; c < p.columns; ++c) {
                for (std::size_t r = 0; r < p.rows; ++r) p.indices.push_back(r);
                p.starts.push_back(p.indices.size());
            }
            return p;
        }
        require(given[2] == 0, of + ": the first column does not begin at zero");
        const Int* const rows = given + 3 + p.columns;
        for (std::size_t c = 0; c < p.columns; ++c) {
            require(given[3 + c] >= given[2 + c], of + ": columns do not rise");
            for (Int i = given[2 + c]; i < given[3 + c]; ++i) {
                require(rows[i] >= 0 && rows[i] < given[0], of + ": a row is outside of the matrix");
                require(i == given[2 + c] || rows[i] > rows[i - 1], of + ": rows of a column do not rise");
                p.indices.push_back(static_cast<std::size_t>(rows[i]));
            }
            p.starts.push_back(p.indices.size());
        }
        return p;
    }

    std::size_t size() const { return indices.size(); }
    /// All entries, column by column.
    Vector spread(const Vector& stored) const {
        Vector all(rows * columns, 0.0);
        for (std::size_t c = 0; c < columns; ++c)
            for (std::size_t i = starts[c]; i < starts[c + 1]; ++i) all[c * rows + indices[i]] = stored[i];
        return all;
    }
};

/// `Int` and `Memory`: what the library was compiled for.
template <class Int, class Memory>
class LoadedFunction {
public:
    LoadedFunction(void* library, const std::string& name) : name_(name), library_(library) {
        call_ = symbol<int (*)(const double**, double**, Int*, double*, Memory)>("");
        const auto ins = symbol<Int (*)()>("_n_in")(), outs = symbol<Int (*)()>("_n_out")();
        const auto pattern_in = symbol<const Int* (*)(Int)>("_sparsity_in"), pattern_out = symbol<const Int* (*)(Int)>("_sparsity_out");
        for (Int i = 0; i < ins; ++i) in.push_back(Pattern::read(pattern_in(i), name + ", argument " + std::to_string(i)));
        for (Int i = 0; i < outs; ++i) out.push_back(Pattern::read(pattern_out(i), name + ", result " + std::to_string(i)));
        require(pattern_in(-1) == nullptr && pattern_in(ins) == nullptr && pattern_out(-1) == nullptr && pattern_out(outs) == nullptr,
                name + ": patterns behind the last one");
        Int sizes[4] = {-1, -1, -1, -1};
        require(symbol<int (*)(Int*, Int*, Int*, Int*)>("_work")(sizes, sizes + 1, sizes + 2, sizes + 3) == 0, name + ": no work sizes");
        require(sizes[0] >= ins && sizes[1] >= outs && sizes[2] >= 0 && sizes[3] >= 0, name + ": work sizes");
        for (std::size_t i = 0; i < 4; ++i) sizes_[i] = static_cast<std::size_t>(sizes[i]);
    }

    template <class Symbol>
    Symbol symbol(const char* after) const {
        void* const found = dlsym(library_, (name_ + after).c_str());
        require(found != nullptr, name_ + after + " is not there");
        return reinterpret_cast<Symbol>(found);
    }

    void names_are(const std::vector<std::string>& ins, const std::vector<std::string>& outs) const {
        const auto same = [&](const char* after, const std::vector<std::string>& names, std::size_t count) {
            const auto name = symbol<const char* (*)(Int)>(after);
            require(names.size() == count, name_ + after + ": " + std::to_string(count));
            for (std::size_t i = 0; i < count; ++i) require(name(static_cast<Int>(i)) == names[i], name_ + after + ": " + names[i]);
            require(name(static_cast<Int>(count)) == nullptr, name_ + after + " behind the last one");
        };
        same("_name_in", ins, in.size());
        same("_name_out", outs, out.size());
    }

    /// Stored entries of all results; arguments without values are left out, and so are results that are not `wanted`. What the function
    /// may work with is as large as it asks for.
    std::vector<Vector> operator()(const std::vector<Vector>& arguments, std::vector<bool> wanted = {}) const {
        wanted.resize(out.size(), wanted.empty());
        std::vector<const double*> args(sizes_[0], nullptr);
        std::vector<double*> results(sizes_[1], nullptr);
        std::vector<Int> whole(sizes_[2]);
        Vector real(sizes_[3]);
        std::vector<Vector> values;
        require(arguments.size() == in.size(), name_ + ": number of arguments");
        for (std::size_t i = 0; i < in.size(); ++i) {
            require(arguments[i].empty() || arguments[i].size() == in[i].size(), name_ + ": size of argument " + std::to_string(i));
            if (!arguments[i].empty()) args[i] = arguments[i].data();
        }
        for (const Pattern& p : out) values.emplace_back(p.size(), -12345.0);
        for (std::size_t i = 0; i < out.size(); ++i)
            if (wanted[i]) results[i] = values[i].data();
        require(call_(args.data(), results.data(), whole.data(), real.data(), Memory()) == 0, name_ + " fails");
        return values;
    }
    /// The same with all entries.
    std::vector<Vector> whole(const std::vector<Vector>& arguments, const std::vector<bool>& wanted = {}) const {
        std::vector<Vector> values = (*this)(arguments, wanted);
        for (std::size_t i = 0; i < out.size(); ++i) values[i] = out[i].spread(values[i]);
        return values;
    }

    std::vector<Pattern> in, out;
    const std::string& name() const { return name_; }

private:
    std::string name_;
    void* library_;
    int (*call_)(const double**, double**, Int*, double*, Memory);
    std::size_t sizes_[4];
};
