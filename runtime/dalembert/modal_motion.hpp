// SPDX-License-Identifier: BSL-1.0
// The modal form in real numbers (2.144), and motions by it.
#pragma once

#include "dalembert/modal.hpp"

namespace dalembert {
inline namespace v1 {

namespace detail {

/// exp(A), by scaling, a Taylor series and squaring.
inline Eigen::MatrixXd exponential(Eigen::MatrixXd A) {
    const int squarings = std::max(0, std::ilogb(std::max(A.norm(), 1e-9)) + 2);
    A /= std::ldexp(1.0, squarings);
    Eigen::MatrixXd sum = Eigen::MatrixXd::Identity(A.rows(), A.cols()), term = sum;
    for (int i = 1; i <= 18; ++i) {  // 0.5^19/19! < 2e-23
        term = multiply_real(term, A / i);
        sum += term;
    }
    for (int i = 0; i < squarings; ++i) sum = multiply_real(sum, sum);
    return sum;
}

}  // namespace detail

/// The real form (2.144): x = basis z, z = inverse x, dz/dt = A z + input f, all real: for a pair [Re lambda, -Im lambda; Im lambda, Re lambda].
struct RealModalForm {
    Eigen::MatrixXd A, basis, inverse, input;
    std::vector<ModalBlock> blocks;  ///< of A; those of pairs have twice the size

    /// x at time t from x0, both [q; qd], with constant forces f.
    Eigen::VectorXd motion(const Eigen::VectorXd& x0, const Eigen::VectorXd& f, double t) const {
        Eigen::VectorXd z = detail::multiply_real(inverse, x0);
        const Eigen::VectorXd push = detail::multiply_real(input, f);
        for (const ModalBlock& block : blocks) {
            Eigen::MatrixXd driven = Eigen::MatrixXd::Zero(block.size + 1, block.size + 1);
            driven.topRows(block.size) << A.block(block.first, block.first, block.size, block.size) * t, push.segment(block.first, block.size) * t;
            const double size = std::max(driven.col(block.size).norm(), 1.0);  // large forces would need many squarings
            driven.col(block.size) /= size;
            Eigen::VectorXd start(block.size + 1);
            start << z.segment(block.first, block.size), size;
            z.segment(block.first, block.size) = detail::multiply_real(detail::exponential(driven), start).col(0).head(block.size);
        }
        return detail::multiply_real(basis, z);
    }
};

inline RealModalForm real_form(const Modes& modes) {
    const Eigen::Index N = modes.vectors.rows();
    RealModalForm form{Eigen::MatrixXd::Zero(N, N), Eigen::MatrixXd(N, N), Eigen::MatrixXd(N, N), Eigen::MatrixXd(N, modes.input.cols()), {}};
    Eigen::Index at = 0;
    for (const ModalBlock& block : modes.blocks) {
        const Eigen::Index i = block.first, k = block.size;
        const double share = block.is_real ? 1 : 2;
        form.A.block(at, at, k, k) = modes.matrix.block(i, i, k, k).real();
        form.basis.middleCols(at, k) = share * modes.vectors.middleCols(i, k).real();
        form.inverse.middleRows(at, k) = modes.inverse.middleRows(i, k).real();
        form.input.middleRows(at, k) = modes.input.middleRows(i, k).real();
        form.blocks.push_back({at, block.is_real ? k : 2 * k, true});
        at += k;
        if (block.is_real) continue;
        form.A.block(at, at, k, k) = modes.matrix.block(i, i, k, k).real();
        form.A.block(at, at - k, k, k) = modes.matrix.block(i, i, k, k).imag();
        form.A.block(at - k, at, k, k) = -modes.matrix.block(i, i, k, k).imag();
        form.basis.middleCols(at, k) = -2 * modes.vectors.middleCols(i, k).imag();
        form.inverse.middleRows(at, k) = modes.inverse.middleRows(i, k).imag();
        form.input.middleRows(at, k) = modes.input.middleRows(i, k).imag();
        at += k;
    }
    return form;
}

}  // namespace v1
}  // namespace dalembert
