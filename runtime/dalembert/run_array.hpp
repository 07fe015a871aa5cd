// SPDX-License-Identifier: BSL-1.0
// Arrays whose size belongs to a run: those of plants, which a program loads and whose sizes it learns then.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <type_traits>
#include <utility>

#include "dalembert/sizes.hpp"

namespace dalembert {
inline namespace v1 {
namespace detail {

/// An array with as many entries as Size::of_run() says when it is made, all of them zero. The rest is as of std::array. Short ones take no
/// heap.
template <class Size, class T>
class RunArray {
    static constexpr std::size_t most_without_heap = sizeof(T) > 64 ? 1 : 128 / sizeof(T);
    static constexpr bool has_halves = std::is_trivially_copyable_v<T> && most_without_heap > 1;
    static constexpr std::size_t half = (most_without_heap + 1) / 2;

public:
    using value_type = T;
    using size_type = std::size_t;
    using difference_type = std::ptrdiff_t;
    using reference = T&;
    using const_reference = const T&;
    using iterator = T*;
    using const_iterator = const T*;

    RunArray() : RunArray(Size::of_run()) {}
    RunArray(const RunArray& other) : size_(other.size_), long_(other.long_ != nullptr ? new T[size_] : nullptr), data_(place()) {
        copy(other);
    }
    RunArray(RunArray&& other) : size_(other.size_), long_(std::move(other.long_)), data_(place()) {
        if (long_ == nullptr) take_short(std::move(other));
        other.clear();
    }
    RunArray& operator=(const RunArray& other) {
        if (size_ != other.size_) return *this = RunArray(other);
        copy(other);
        return *this;
    }
    RunArray& operator=(RunArray&& other) {
        if (long_ == nullptr && size_ == other.size_) return *this = std::as_const(other);
        long_ = std::move(other.long_);
        size_ = other.size_;
        data_ = place();
        if (long_ == nullptr) take_short(std::move(other));
        other.clear();
        return *this;
    }
    ~RunArray() = default;

    std::size_t size() const noexcept { return size_; }
    T* data() noexcept { return data_; }
    const T* data() const noexcept { return data_; }
    T* begin() noexcept { return data(); }
    T* end() noexcept { return data() + size_; }
    const T* begin() const noexcept { return data(); }
    const T* end() const noexcept { return data() + size_; }
    T& operator[](std::size_t i) noexcept { return data()[i]; }
    const T& operator[](std::size_t i) const noexcept { return data()[i]; }
    T& back() noexcept { return data()[size_ - 1]; }
    const T& back() const noexcept { return data()[size_ - 1]; }
    void fill(const T& value) { std::fill(begin(), end(), value); }
    friend bool operator==(const RunArray& a, const RunArray& b) { return std::equal(a.begin(), a.end(), b.begin(), b.end()); }
    friend bool operator!=(const RunArray& a, const RunArray& b) { return !(a == b); }

private:
    explicit RunArray(std::size_t size) : size_(size), long_(size > most_without_heap ? new T[size]() : nullptr), data_(place()) {
        std::fill_n(short_.data(), has_halves && size <= half ? half : most_without_heap, T());
    }
    T* place() noexcept { return long_ != nullptr ? long_.get() : short_.data(); }
    void clear() noexcept {
        size_ = 0;
        data_ = short_.data();
    }
    void copy(const RunArray& other) {
        if (long_ == nullptr)
            take_short(other);
        else
            std::copy(other.begin(), other.end(), begin());
    }
    /// One half or both: that is faster than so many entries.
    template <class Other>
    void take_short(Other&& other) {
        if (has_halves && other.size_ <= half)
            std::copy_n(other.short_.data(), half, short_.data());
        else
            short_ = std::forward<Other>(other).short_;
    }

    std::size_t size_;
    std::array<T, most_without_heap> short_;
    std::unique_ptr<T[]> long_;
    T* data_;  ///< of the one that is used: asking which at every entry takes time
};

/// So many entries more.
template <class Size, std::size_t more>
struct LongerSize {
    static std::size_t of_run() noexcept { return Size::of_run() + more; }
};
/// The entries of both.
template <class First, class Second>
struct SumOfSizes {
    static std::size_t of_run() noexcept { return First::of_run() + Second::of_run(); }
};

template <class S, class T>
struct ArrayTraits<RunArray<S, T>> {
    using Size = S;
    static constexpr bool is_fixed = false;
    static constexpr bool may_have_entries = true;
    template <class U>
    using Like = RunArray<S, U>;
    template <std::size_t more>
    using Longer = RunArray<LongerSize<S, more>, T>;
};
template <class S, class R, class T>
struct JoinedArrays<RunArray<S, T>, RunArray<R, T>> {
    using type = RunArray<SumOfSizes<S, R>, T>;
};
template <class S, class T>
struct EntriesMore<RunArray<S, T>, RunArray<S, T>> : std::integral_constant<std::size_t, 0> {};
template <class S, class T, std::size_t more>
struct EntriesMore<RunArray<LongerSize<S, more>, T>, RunArray<S, T>> : std::integral_constant<std::size_t, more> {};

}  // namespace detail
}  // namespace v1
}  // namespace dalembert
