// SPDX-License-Identifier: GPL-3.0-or-later
// Plants as shared libraries: compiled, kept in the user's cache, loaded.
#pragma once

#include <dalembert/controller.h>
#include <dalembert/plant.h>

#include <filesystem>
#include <memory>
#include <string>

namespace dalembert {

/// What is compiled: the header of a system, and the file that exports it.
struct PlantSource {
    std::string header_name, header;
    std::string source;
};

/// Whether plants that were compiled once are kept for the next time.
enum class PlantCache { used, unused };

/// Where a library came from: "compiled, kept as FILE".
struct PlantOrigin {
    double seconds = 0;
    std::string text;
    bool is_kept = false;  ///< it was compiled before
};

/// What a library exports: a plant, or a controller that samples.
enum class Exports { plant, controller };

class PlantLibrary {
public:
    /// Compiles, or takes what was compiled before from the same text with the same compiler, and loads. Throws Failure (tool-failed).
    PlantLibrary(const PlantSource& source, PlantCache cache, Exports exports = Exports::plant);
    /// Loads a library that somebody else made. Throws Failure (unreadable-file, bad-plant).
    explicit PlantLibrary(const std::filesystem::path& file);

    const dalembert_plant& table() const { return *table_; }
    const dalembert_controller& controller() const { return *controller_; }
    /// How long it took, and what was done.
    const PlantOrigin& origin() const { return origin_; }

private:
    std::string take(const PlantSource& source, PlantCache cache);
    void load(const std::filesystem::path& file);

    struct Close {
        void operator()(void* handle) const;
    };
    std::unique_ptr<void, Close> handle_;
    Exports exports_ = Exports::plant;
    const dalembert_plant* table_ = nullptr;
    const dalembert_controller* controller_ = nullptr;
    PlantOrigin origin_;
};

/// Compiles a plant into a file. Throws Failure (tool-failed).
void compile_plant(const PlantSource& source, const std::filesystem::path& library);

/// The folder of the cache: $XDG_CACHE_HOME/dalembert, else ~/.cache/dalembert; empty where there is neither.
std::filesystem::path plant_cache_folder();

}  // namespace dalembert
