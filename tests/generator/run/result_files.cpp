// SPDX-License-Identifier: GPL-3.0-or-later
// Result files for MATLAB are read again by libmatio; of archives the texts are looked at. tests/export/results.sh reads them with numpy
// and Octave.
#include "run/result_files.hpp"

#include <doctest/doctest.h>
#include <matio.h>

#include <filesystem>
#include <memory>

#include "text/archive.hpp"
#include "text/files.hpp"
#include "text/process.hpp"

using namespace dalembert;

namespace {

const Recording recording{{{"t", "s"}, {"dot(phi)", "rad/s"}, {"T[1]", "K"}, {"T_1", "K"}, {"mode", ""}},
                          {{0, 1.5, 300, 301, 0}, {0.1, -2, 310, 311, 1}}};

struct File {
    ScratchFolder folder;
    std::unique_ptr<mat_t, int (*)(mat_t*)> mat{nullptr, Mat_Close};
    explicit File(const std::string& bytes) {
        const std::string path = (std::filesystem::path(folder.path()) / "read.mat").string();
        write_files({{path, bytes}});
        mat.reset(Mat_Open(path.c_str(), MAT_ACC_RDONLY));
    }
};

std::vector<double> field(matvar_t* structure, const char* name) {
    const matvar_t* values = Mat_VarGetStructFieldByName(structure, name, 0);
    REQUIRE(values != nullptr);
    const auto* numbers = static_cast<const double*>(values->data);
    return {numbers, numbers + values->dims[0]};
}

/// Texts of a cell: version 5 has them as UTF-8, version 7.3 in 16 bits.
std::vector<std::string> texts(matvar_t* cell) {
    std::vector<std::string> result;
    for (std::size_t i = 0; i < cell->dims[0]; ++i) {
        const matvar_t* one = Mat_VarGetCell(cell, static_cast<int>(i));
        std::string text;
        for (std::size_t k = 0; k < one->nbytes / static_cast<std::size_t>(one->data_size); ++k)
            text += static_cast<const char*>(one->data)[k * static_cast<std::size_t>(one->data_size)];
        result.push_back(text);
    }
    return result;
}

}  // namespace

TEST_CASE("files for MATLAB hold the table, with names that MATLAB can have") {
    const ResultTable table{recording, {{0.05, "stops", "slides", "sticks"}}, {"slides", "sticks"}};
    for (const bool is_hdf5 : {false, true}) {
        CAPTURE(is_hdf5);
        File file(mat_file(table, is_hdf5));
        REQUIRE(file.mat != nullptr);
        CHECK(Mat_GetVersion(file.mat.get()) == (is_hdf5 ? MAT_FT_MAT73 : MAT_FT_MAT5));
        const std::unique_ptr<matvar_t, void (*)(matvar_t*)> run(Mat_VarRead(file.mat.get(), "run"), Mat_VarFree);
        REQUIRE(run != nullptr);
        CHECK(field(run.get(), "t") == std::vector{0, 0.1});
        CHECK(field(run.get(), "phi_dot") == std::vector{1.5, -2.0});
        CHECK(field(run.get(), "T_1") == std::vector{300.0, 310.0});
        CHECK(field(run.get(), "T_1_") == std::vector{301.0, 311.0});
        const std::unique_ptr<matvar_t, void (*)(matvar_t*)> names(Mat_VarRead(file.mat.get(), "names"), Mat_VarFree),
            units(Mat_VarRead(file.mat.get(), "units"), Mat_VarFree), events(Mat_VarRead(file.mat.get(), "events"), Mat_VarFree);
        REQUIRE(names != nullptr);
        REQUIRE(units != nullptr);
        REQUIRE(events != nullptr);
        CHECK(texts(names.get()) == std::vector<std::string>{"t", "dot(phi)", "T[1]", "T_1", "mode"});
        CHECK(texts(units.get())[1] == "rad/s");
        CHECK(field(events.get(), "t") == std::vector{0.05});
        CHECK(texts(Mat_VarGetStructFieldByName(events.get(), "name", 0)) == std::vector<std::string>{"stops"});
    }
}

TEST_CASE("files for numpy are an archive of arrays") {
    const std::string bytes = npz_file({recording, {}, {}});
    CHECK(bytes.starts_with("PK\x03\x04"));
    for (const char* name : {"names.npy", "units.npy", "dot(phi).npy", "T[1].npy"}) CHECK(bytes.find(name) != std::string::npos);
    CHECK(bytes.find("event") == std::string::npos);
    CHECK(bytes == npz_file({recording, {}, {}}));
}

TEST_CASE("archives hold files as they are, with the first time that zip knows") {
    const std::string stored = zip_archive({{"a/b.txt", "some text"}, {"c", ""}}, Packing::stored);
    CHECK(stored.find("a/b.txtsome text") != std::string::npos);
    CHECK(stored.compare(10, 4, std::string("\0\0\x21\0", 4)) == 0);  // 0:00:00, 1 January 1980
    CHECK(zip_archive({{"a", std::string(10000, 'x')}}).size() < 500);
}
