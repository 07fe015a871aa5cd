// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/result_files.hpp"

#include <array>

namespace dalembert {

namespace {

constexpr std::array formats{
    ResultFormat{"mat", "MATLAB 5", ".mat", [](const ResultTable& t) { return mat_file(t, false); }},
    ResultFormat{"mat73", "MATLAB 7.3, which is HDF5", "_v73.mat", [](const ResultTable& t) { return mat_file(t, true); }},
    ResultFormat{"npz", "numpy", ".npz", npz_file},
};

}  // namespace

std::span<const ResultFormat> result_formats() { return formats; }

}  // namespace dalembert
