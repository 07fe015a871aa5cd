// SPDX-License-Identifier: GPL-3.0-or-later
// note [cache]: A plant lies under a number that is made of all that decides its bytes: the text, the runtime headers that it includes, the
// compiler and its options. Beside it lies that text itself, and a plant counts only where it is the same. Files get their names when they
// are complete, the text last: a program that is killed leaves nothing that counts, and two that compile the same plant do each other no
// harm.
#include "plant/library.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <vector>

#include "plant/compiler.hpp"
#include "text/diagnostic.hpp"
#include "text/digest.hpp"
#include "text/files.hpp"
#include "text/process.hpp"

namespace dalembert {

namespace fs = std::filesystem;

namespace {

/// Half the optimisation, for a third less time: calls of a plant are short beside what an integrator does around them.
/// Hidden: of two libraries with the same names each keeps its own tables.
const std::vector<std::string> flags{"-O1",
                                     "-fPIC",
                                     "-shared",
                                     "-fvisibility=hidden",
                                     "-ffp-contract=off",
                                     "-fno-exceptions",
                                     "-fno-rtti",
                                     "-fno-asynchronous-unwind-tables"};

[[noreturn]] void fail(Id id, std::string message, ExitCode code) { throw Failure(Diagnostic{id, {}, std::move(message)}, code); }

std::string content(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// Where the compiler is, of which time and size: another one is another compiler.
std::string identity(const std::string& program) {
    const auto described = [](const fs::path& file) -> std::string {
        struct stat status;
        if (::stat(file.c_str(), &status) != 0) return "";
        return fmt::format("{} {} {}.{}", fs::weakly_canonical(file).string(), status.st_size, status.st_mtim.tv_sec,
                           status.st_mtim.tv_nsec);
    };
    if (program.find('/') != std::string::npos) return described(program);
    const char* path = std::getenv("PATH");
    std::string folders = path != nullptr ? path : "";
    for (std::size_t at = 0; at <= folders.size();) {
        const std::size_t end = std::min(folders.find(':', at), folders.size());
        const fs::path file = fs::path(folders.substr(at, end - at)) / program;
        if (::access(file.c_str(), X_OK) == 0) return described(file);
        at = end + 1;
    }
    return "";
}

/// The headers of the runtime, one after the other: a plant includes some of them.
std::string runtime_text() {
    std::vector<fs::path> files;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(fs::path(runtime_folder()) / "dalembert", error))
        if (entry.is_regular_file(error)) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    std::string text;
    for (const fs::path& file : files) text += file.filename().string() + "\n" + content(file);
    return text;
}

/// All that decides the bytes of a plant.
std::string key_of(const PlantSource& source) {
    std::string key;
    // The first word may only start the compiler, as in "ccache g++".
    for (const std::string& word : compiler_command()) key += word + " " + identity(word) + "\n";
    for (const std::string& flag : flags) key += flag + " ";
    key += fmt::format("\nruntime {:016x}", digest(runtime_text()));
    return key + "\n==== " + source.header_name + "\n" + source.header + "\n====\n" + source.source;
}

/// The oldest plants go, as long as there are too many bytes.
void bound(const fs::path& folder) {
    constexpr std::uintmax_t most_bytes = std::uintmax_t(256) << 20;
    struct Kept {
        fs::file_time_type used;
        fs::path file;
        std::uintmax_t size;
    };
    std::vector<Kept> kept;
    std::uintmax_t bytes = 0;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder, error)) {
        const std::uintmax_t size = entry.file_size(error);
        if (error) continue;
        bytes += size;
        kept.push_back({entry.last_write_time(error), entry.path(), size});
    }
    if (bytes <= most_bytes) return;
    std::sort(kept.begin(), kept.end(), [](const Kept& a, const Kept& b) { return a.used < b.used; });
    for (const Kept& one : kept) {
        if (bytes <= most_bytes / 2) return;
        fs::remove(one.file, error);
        bytes -= one.size;
    }
}

/// Entries outside a matrix would be written over something else.
template <class Refuse>
void check_pattern(const dalembert_pattern& pattern, std::size_t columns, std::size_t rows, const char* matrix, const Refuse& refuse) {
    if (pattern.column_starts == nullptr) return;
    for (std::size_t c = 0; c < columns; ++c) {
        const std::size_t begin = pattern.column_starts[c], end = pattern.column_starts[c + 1];
        if (begin > end || (c == 0 && begin != 0)) refuse(fmt::format("the pattern of {} does not rise at column {}", matrix, c));
        for (std::size_t k = begin; k < end; ++k)
            if (pattern.row_indices == nullptr || pattern.row_indices[k] >= rows)
                refuse(fmt::format("the pattern of {} has an entry outside of its {} rows in column {}", matrix, rows, c));
    }
}

/// Puts a complete file in its place.
bool put(const fs::path& from, const fs::path& to) {
    const fs::path beside = to.string() + fmt::format(".{}", ::getpid());
    std::error_code error;
    fs::copy_file(from, beside, fs::copy_options::overwrite_existing, error);
    if (!error) fs::rename(beside, to, error);
    if (error) {
        std::error_code ignored;
        fs::remove(beside, ignored);
    }
    return !error;
}

}  // namespace

void PlantLibrary::Close::operator()(void* handle) const { ::dlclose(handle); }

fs::path plant_cache_folder() {
    if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache != nullptr && *cache == '/')
        return fs::path(cache) / "dalembert" / "plants";
    if (const char* home = std::getenv("HOME"); home != nullptr && *home == '/') return fs::path(home) / ".cache" / "dalembert" / "plants";
    return {};
}

void compile_plant(const PlantSource& source, const fs::path& library) {
    const ScratchFolder scratch;
    const fs::path at = scratch.path();
    write_files({{at / source.header_name, for_the_compiler(source.header)}, {at / "plant.cpp", source.source}});
    std::vector<std::string> arguments = flags;
    arguments.insert(arguments.end(), {"-I", scratch.path(), (at / "plant.cpp").string(), "-o", library.string()});
    compile(arguments);
}

PlantLibrary::PlantLibrary(const PlantSource& source, PlantCache cache, Exports exports) : exports_(exports) {
    const auto begin = std::chrono::steady_clock::now();
    origin_.text = take(source, cache);
    origin_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// Says what it did.
std::string PlantLibrary::take(const PlantSource& source, PlantCache cache) {
    const fs::path folder = cache == PlantCache::used ? plant_cache_folder() : fs::path();
    std::error_code error;
    if (!folder.empty() && fs::create_directories(folder, error)) fs::permissions(folder, fs::perms::owner_all, error);
    const bool is_kept = !folder.empty() && fs::is_directory(folder, error);
    const std::string key = is_kept ? key_of(source) : "";
    const fs::path library = folder / fmt::format("{:016x}.so", digest(key)), text = folder / fmt::format("{:016x}.txt", digest(key));
    if (is_kept && fs::exists(library, error) && content(text) == key) {
        fs::last_write_time(library, fs::file_time_type::clock::now(), error);
        fs::last_write_time(text, fs::file_time_type::clock::now(), error);
        try {
            load(library);
            origin_.is_kept = true;
            return "kept before as " + library.string();
        } catch (const Failure&) {  // somebody has changed it: it is made anew
        }
    }
    const ScratchFolder scratch;
    const fs::path made = fs::path(scratch.path()) / "plant.so", made_text = fs::path(scratch.path()) / "plant.txt";
    compile_plant(source, made);
    load(made);
    if (!is_kept) return cache == PlantCache::unused ? "compiled, not kept" : "compiled, not kept: there is no folder for caches";
    std::ofstream(made_text, std::ios::binary) << key;
    const bool is_put = put(made, library) && put(made_text, text);
    bound(folder);
    return is_put ? "compiled, kept as " + library.string() : "compiled, not kept: " + folder.string() + " cannot be written";
}

PlantLibrary::PlantLibrary(const fs::path& file) {
    std::error_code error;
    if (!fs::exists(file, error)) fail(Id::unreadable_file, fmt::format("there is no file '{}'", file.string()), ExitCode::bad_input);
    load(fs::absolute(file));
    origin_.text = "loaded from " + file.string();
}

void PlantLibrary::load(const fs::path& file) {
    const auto refuse = [&](const std::string& why) {
        fail(Id::bad_plant, fmt::format("'{}' is no plant: {}", file.string(), why), ExitCode::bad_input);
    };
    handle_.reset(::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL));
    if (handle_ == nullptr) refuse(::dlerror());
    if (exports_ == Exports::controller) {  // the program has made it
        controller_ = reinterpret_cast<dalembert_controller_function>(::dlsym(handle_.get(), DALEMBERT_CONTROLLER_FUNCTION))();
        return;
    }
    const auto function = reinterpret_cast<dalembert_plant_function>(::dlsym(handle_.get(), DALEMBERT_PLANT_FUNCTION));
    if (function == nullptr) refuse(fmt::format("it does not export the function {}", DALEMBERT_PLANT_FUNCTION));
    table_ = function();
    if (table_ == nullptr) refuse("its table is null");
    if (table_->version != DALEMBERT_PLANT_VERSION || table_->size != sizeof(dalembert_plant))
        refuse(fmt::format("its table has version {} and {} bytes, and this program reads version {} with {} bytes", table_->version,
                           table_->size, DALEMBERT_PLANT_VERSION, sizeof(dalembert_plant)));
    const auto need = [&](bool is_there, const char* what) {
        if (!is_there) refuse(fmt::format("its table has no {}", what));
    };
    const dalembert_plant& p = *table_;
    need(p.name != nullptr && p.scene != nullptr && p.title != nullptr, "name, scene or title");
    need(p.create != nullptr && p.destroy != nullptr && p.set_parameters != nullptr && p.start_state != nullptr,
         "create, destroy, set_parameters or start_state");
    need(p.rhs != nullptr && p.rhs_and_jacobian != nullptr, "rhs or rhs_and_jacobian");
    need(p.states == 0 || (p.state_table != nullptr && p.start_values != nullptr), "state_table or start_values");
    need(p.inputs == 0 || (p.input_table != nullptr && p.jacobian_u != nullptr), "input_table or jacobian_u");
    need(p.outputs == 0 || (p.output_table != nullptr && p.output != nullptr), "output_table or output");
    need(p.parameters == 0 || (p.parameter_table != nullptr && p.parameter_defaults != nullptr), "parameter_table or parameter_defaults");
    need(p.guards == 0 || (p.guard_table != nullptr && p.guard_values != nullptr), "guard_table or guard_values");
    need(p.modes == 0 ||
             (p.mode_names != nullptr && p.event_names != nullptr && p.events > 0 && p.guard_values != nullptr &&
              p.guard_rates != nullptr && p.is_watched != nullptr && p.reset != nullptr && p.settle != nullptr && p.transitions != nullptr),
         "functions of events");
    need(p.kinks == 0 || p.kink_values != nullptr, "kink_values");
    need(p.time_switches == 0 || p.time_switch_values != nullptr, "time_switch_values");
    need(p.is_projected == 0 || p.move_back != nullptr, "move_back");
    need(p.constraints == 0 || (p.constraint_table != nullptr && p.constraint_positions != nullptr && p.constraint_rates != nullptr &&
                                p.constraint_jacobian != nullptr && p.correction != nullptr && p.mass_matrix != nullptr),
         "functions of constraints");
    need(p.constraint_rank == 0 || p.solve_for != nullptr, "solve_for");
    if (p.velocity_place + p.degrees > p.states)
        refuse(fmt::format("it has {} velocities from place {} on, but only {} states", p.degrees, p.velocity_place, p.states));
    if (p.is_separable != 0 && 2 * p.degrees != p.states)
        refuse(fmt::format("its table calls it separable, but it has {} states for {} coordinates", p.states, p.degrees));
    check_pattern(p.pattern_x, p.states, p.states, "df/dx", refuse);
    check_pattern(p.pattern_u, p.inputs, p.states, "df/du", refuse);
}

}  // namespace dalembert
