// SPDX-License-Identifier: GPL-3.0-or-later
// What each stage may spend at most, in one place; `dalembert help limits` prints it. Counts come first: they end the same input at the
// same place on every machine. Time and memory catch what no count foresees.
#pragma once

#include <cstddef>
#include <span>

namespace dalembert {

namespace budget {

// reading
inline constexpr std::size_t file_bytes = 1'000'000;
inline constexpr std::size_t words = 20'000;        ///< words and signs of an expression or of a LaTeX text
inline constexpr int nesting = 100;                 ///< brackets, powers, signs in each other
inline constexpr int nested_values = 200;           ///< tables and arrays in each other
inline constexpr std::size_t number_length = 400;   ///< characters
inline constexpr int part_depth = 16;               ///< parts in each other
inline constexpr std::size_t parts = 1'000;         ///< of a model, with those in them
inline constexpr int number_exponent = 400;
// what definitions and outputs come to when one is written into the other
inline constexpr double written_depth = 20'000;
inline constexpr double written_size = 40'000;
inline constexpr double printed_size = 400'000;      ///< of a printed equation, whose letters mostly have numbers
// numbers
inline constexpr int exponent = 1'000;              ///< also the degree of what powers and products of powers come to
inline constexpr std::size_t bits = 100'000;        ///< of an exact number
inline constexpr int magnitude = 300;               ///< constants and values lie between 1e-300 and 1e300
// sums and families
inline constexpr int sum_terms = 10'000;
inline constexpr long long all_sum_terms = 100'000; ///< of an expression, with sums in sums
// derivation and proofs
inline constexpr std::size_t coordinates = 128;
inline constexpr std::size_t states = 1024;
inline constexpr std::size_t polynomial_terms = 200'000;
inline constexpr double polynomial_products = 2e7;  ///< of one multiplication
inline constexpr double proof_work = 1e9;           ///< of a proof: products of terms, weighed by the length of their numbers
inline constexpr double code_work = 3e7;            ///< of an expression that becomes code: products of terms
inline constexpr std::size_t hessian_parts = 20'000;  ///< of equations of motion that are differentiated twice
inline constexpr std::size_t suggestion_parts = 600;
// modes
inline constexpr std::size_t mode_combinations = 4'096;
inline constexpr std::size_t modes = 256;           ///< of these, that can be
// an entry of a catalogue, in a process of its own
inline constexpr int entry_seconds = 300;           ///< of processor time
inline constexpr std::size_t entry_bytes = 4'000'000'000;
// runs
inline constexpr double steps = 1e8;                ///< as in IntegrationOptions::max_steps
inline constexpr int samples = 1'000'000;
// time and memory, beside the counts
inline constexpr double stage_seconds = 900;        ///< of processor time
inline constexpr double memory_bytes = 6e9;

}  // namespace budget

struct StageBudget {
    const char* stage;
    const char* what;    ///< what is counted
    double most;
    const char* beyond;  ///< what happens beyond
};

/// The table of `help limits`.
std::span<const StageBudget> budgets();

}  // namespace dalembert
