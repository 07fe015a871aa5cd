// SPDX-License-Identifier: GPL-3.0-or-later
// The result of `dalembert modal`: (2.117) to (2.144) of a machine at its start.
#pragma once

#include <optional>

#include "report/matrix_text.hpp"

namespace dalembert {

struct ModalMode {
    Complex eigenvalue;  ///< 1/s
    Complex alpha;
    std::size_t block;   ///< counted from 1
    std::size_t size;    ///< of the block
    bool is_real;
    std::vector<Complex> vector, row, input;
    double frequency() const { return std::abs(eigenvalue); }  ///< rad/s
    /// Nothing without a frequency.
    std::optional<double> damping_ratio() const {
        return frequency() > 0 ? std::optional(-eigenvalue.real() / frequency()) : std::nullopt;
    }
};

/// How constraints leave motions free.
struct ModalReduction {
    bool is_closed;                        ///< the independent coordinates have equations of second order
    std::vector<std::string> coordinates;  ///< independent ones
    std::vector<std::string> apart;        ///< states that are free besides
    std::vector<std::string> free_states;
    std::vector<Complex> of_apart;         ///< eigenvalues, 1/s
    MatrixRows N;
};

/// A matrix of the machine.
struct ModalMatrix {
    std::string name;
    MatrixRows rows;
    std::string definiteness;  ///< "positive definite", "zero"; empty where it is not told
};

struct ModalResult {
    Subject subject;
    std::string status;      ///< "success", or why there is no modal form
    std::string not_linear;  ///< why; empty where the machine is linear
    bool is_linear = false;
    double largest_acceleration = 0;  ///< at the start
    std::vector<std::string> coordinates = {};
    std::optional<ModalReduction> reduction = {};  ///< of a machine with constraints
    std::vector<ResultValue> states = {}, inputs = {};   ///< the start
    std::vector<ModalMatrix> matrices = {};        ///< M, D, C, B
    std::vector<ModalMode> modes = {};
    bool found() const { return status == "success"; }
    /// Those of the modes.
    const std::vector<std::string>& modal_coordinates() const { return reduction ? reduction->coordinates : coordinates; }
};

std::string as_text(const ModalResult& result);
nlohmann::ordered_json as_json(const ModalResult& result);

}  // namespace dalembert
