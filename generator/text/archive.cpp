// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/archive.hpp"

#include <zip.h>

#include <memory>
#include <stdexcept>

namespace dalembert {

namespace {

[[noreturn]] void fail(const std::string& what) { throw std::runtime_error("the zip archive cannot be written: " + what); }

struct Discard {
    void operator()(zip_t* archive) const { zip_discard(archive); }
};
struct Free {
    void operator()(zip_source_t* source) const { zip_source_free(source); }
};

void add(zip_t* archive, const std::string& name, const std::string& content, Packing packing) {
    zip_source_t* const source = zip_source_buffer(archive, content.data(), content.size(), 0);
    if (source == nullptr) fail(zip_strerror(archive));
    const zip_int64_t place = zip_file_add(archive, name.c_str(), source, ZIP_FL_ENC_UTF_8);
    if (place < 0) {
        zip_source_free(source);
        fail(zip_strerror(archive));
    }
    const auto index = static_cast<zip_uint64_t>(place);
    constexpr zip_uint16_t first_day = 1 << 5 | 1;  // of January 1980, as DOS writes it: no time zone changes it
    constexpr zip_uint32_t readable = 0100644U << 16;
    if (zip_set_file_compression(archive, index, packing == Packing::stored ? ZIP_CM_STORE : ZIP_CM_DEFLATE, 9) != 0 ||
        zip_file_set_dostime(archive, index, 0, first_day, 0) != 0 ||
        zip_file_set_external_attributes(archive, index, 0, ZIP_OPSYS_UNIX, readable) != 0)
        fail(zip_strerror(archive));
}

std::string read_all(zip_source_t* source) {
    zip_stat_t about;
    if (zip_source_stat(source, &about) != 0 || zip_source_open(source) != 0) fail(zip_error_strerror(zip_source_error(source)));
    std::string bytes(about.size, '\0');
    const bool is_whole = zip_source_read(source, bytes.data(), bytes.size()) == static_cast<zip_int64_t>(bytes.size());
    zip_source_close(source);
    if (!is_whole) fail("it is not whole");
    return bytes;
}

}  // namespace

std::string zip_archive(const FileContents& files, Packing packing) {
    zip_error_t error;
    zip_error_init(&error);
    const std::unique_ptr<zip_source_t, Free> bytes(zip_source_buffer_create(nullptr, 0, 0, &error));
    if (!bytes) fail(zip_error_strerror(&error));
    zip_source_keep(bytes.get());  // closing the archive frees it once
    std::unique_ptr<zip_t, Discard> archive(zip_open_from_source(bytes.get(), ZIP_TRUNCATE, &error));
    if (!archive) {
        zip_source_free(bytes.get());
        fail(zip_error_strerror(&error));
    }
    for (const auto& [path, content] : files) add(archive.get(), path.generic_string(), content, packing);
    if (zip_close(archive.get()) != 0) fail(zip_strerror(archive.get()));
    static_cast<void>(archive.release());
    return read_all(bytes.get());
}

}  // namespace dalembert
