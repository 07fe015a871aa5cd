// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/budgets.hpp"

#include <array>

namespace dalembert {

namespace {

constexpr std::array table{
    StageBudget{"reading", "bytes of a file", budget::file_bytes, "error file-too-large"},
    StageBudget{"reading", "nested tables and lists", budget::nested_values, "error too-deep"},
    StageBudget{"reading", "words and signs of an expression", budget::words, "error too-long"},
    StageBudget{"reading", "nested brackets, powers and signs", budget::nesting, "error too-deep"},
    StageBudget{"reading", "characters of a number", budget::number_length, "error number-too-large"},
    StageBudget{"reading", "decimal exponent of a number", budget::number_exponent, "error number-too-large"},
    StageBudget{"reading", "parts in each other", budget::part_depth, "error too-deep"},
    StageBudget{"reading", "parts of a model, with those in them", budget::parts, "error too-large"},
    StageBudget{"checks", "nested operations, with definitions written out", budget::written_depth, "error too-large"},
    StageBudget{"checks", "operations of an expression, with definitions written out", budget::written_size, "error too-large"},
    StageBudget{"checks", "operations of a printed equation, with letters written out", budget::printed_size, "error too-large"},
    StageBudget{"checks", "degree of an expression, with definitions written out", budget::exponent, "error too-large"},
    StageBudget{"numbers", "exponent of a power", budget::exponent, "error number-too-large"},
    StageBudget{"numbers", "bits of an exact number", budget::bits, "error number-too-large"},
    StageBudget{"numbers", "decimal exponent of a value", budget::magnitude, "error number-too-large"},
    StageBudget{"sums", "terms of a sum", budget::sum_terms, "error too-large"},
    StageBudget{"sums", "members of a family", budget::sum_terms, "error too-large"},
    StageBudget{"sums", "terms of all sums in an expression", static_cast<double>(budget::all_sum_terms), "error too-large"},
    StageBudget{"derivation", "coordinates", budget::coordinates, "error too-large"},
    StageBudget{"derivation", "states, without cells of rods in loops", budget::states, "error too-large"},
    StageBudget{"derivation", "combinations of modes", budget::mode_combinations, "error too-large"},
    StageBudget{"derivation", "possible modes", budget::modes, "error too-large"},
    StageBudget{"proofs", "terms of a polynomial", budget::polynomial_terms, "not proven, but compared at points"},
    StageBudget{"proofs", "products of terms in one multiplication", budget::polynomial_products, "not proven, but compared at points"},
    StageBudget{"proofs", "products of terms in one proof, by 64 bits", budget::proof_work, "not proven, but compared at points"},
    StageBudget{"code", "products of terms in one expression", budget::code_work, "error too-large"},
    StageBudget{"code", "parts of the equations of motion, with second derivatives", budget::hessian_parts, "error bad-option"},
    StageBudget{"printed equations", "parts of an equation with suggestions", budget::suggestion_parts, "no suggestion"},
    StageBudget{"printed equations", "seconds of processor time of an entry, or --stage-seconds if less", budget::entry_seconds,
                "not checked, exit code 1"},
    StageBudget{"printed equations", "bytes of memory of an entry, or --memory if less", static_cast<double>(budget::entry_bytes),
                "not checked, exit code 1"},
    StageBudget{"runs", "steps", budget::steps, "error bad-option, or the run stops"},
    StageBudget{"runs", "samples", budget::samples, "error value-out-of-range"},
    StageBudget{"any stage", "seconds of processor time (--stage-seconds)", budget::stage_seconds, "the program stops, error too-large"},
    StageBudget{"any stage", "bytes of memory (--memory, in GB)", budget::memory_bytes, "the program stops, error too-large"},
};

}  // namespace

std::span<const StageBudget> budgets() { return table; }

}  // namespace dalembert
