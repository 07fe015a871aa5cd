// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/gallery.hpp"

#include <fmt/format.h>

#include <optional>
#include <ostream>

#include "command/check.hpp"
#include "elements/model.hpp"
#include "form/state_places.hpp"
#include "report/small_plot.hpp"
#include "run/in_parallel.hpp"
#include "run/run_preparation.hpp"
#include "run/shared.hpp"
#include "run/simulation.hpp"

namespace dalembert {

namespace fs = std::filesystem;

namespace {

/// Where the files of a gallery are, without links of the file system followed.
struct GalleryPlaces {
    fs::path pages, generated;

    explicit GalleryPlaces(const Options& options)
        : pages(plain(options.output)), generated(options.generated.empty() ? pages : plain(options.generated)) {}
    static fs::path plain(const fs::path& path) { return fs::absolute(path).lexically_normal(); }
    std::string link(const fs::path& file) const { return file.lexically_relative(pages).generic_string(); }
};

/// A system before its run.
struct GalleryMachine {
    GalleryEntry entry;
    std::shared_ptr<const LoadedModel> model;
    Machine machine;                             ///< where nothing is run
    std::optional<PreparedSimulation> simulation;
    std::vector<PrintedRow> printed;
    bool failed = false;

    const Machine& derived() const { return simulation ? simulation->machine : machine; }
};

struct GalleryRun {
    std::string picture, status;
    bool is_good = true;
    std::size_t stiff_steps = 0;
};

/// The degrees of freedom that constraints leave, in the mode that has most.
std::size_t freedom(const Machine& machine) {
    const System& system = *machine.system;
    std::size_t held = 0;
    for (const std::size_t place : system.motion.multipliers) held += system.constraints[place].is_redundant ? 0 : 1;
    std::size_t most = system.motion.free.size() - held;
    for (const Machine& other : machine.other_modes) most = std::max(most, freedom(other));
    return most;
}

GalleryMachine prepare_entry(const std::string& path, const GalleryPlaces& places, const Options& options, Streams streams) {
    Options one = options;
    one.models = {path};
    one.choice.model = path;
    one.format = "json";  // the check of a gallery prints nothing
    GalleryMachine made;
    made.model = loaded(one, streams);
    const Model& model = made.model->model;
    const CheckedFile checked = check_file(path, one, streams);
    made.failed = checked.failed;
    const bool has_run = find_run(model, "") != nullptr;
    const std::string scene = has_run && !scene_of_run(model, "").empty() ? scene_of_run(model, "") : resolve_scene(model, "");
    if (has_run) made.simulation = prepare_simulation(made.model, scene, one);
    else {
        made.machine = derive_machine(made.model, scene, {});
        generate(made.machine);
    }
    const System& system = *made.derived().system;
    GalleryEntry& e = made.entry;
    e.name = model.name;
    e.title = model.title.empty() ? model.name : model.title;
    e.doc = model.doc;
    e.source = model.reference;
    e.domain = fs::absolute(path).lexically_normal().parent_path().filename().string();
    e.scene = system.scene.name;
    e.scenes = scene_names(model).size();
    e.degrees = freedom(made.derived());
    e.coordinates = system.symbols.degrees();
    e.states = place_states(system).count;
    e.operations = operations(made.derived(), Function::rhs).total();
    for (const CheckedScene& one_scene : checked.scenes)
        for (const CheckedScene::Group& group : one_scene.groups)
            for (const CheckedScene::Proof& proof : group.proofs) e.proofs.add(proof.verdict);
    e.printed = checked.part.counts;
    e.numbers = number_ranges(checked.part.rows);
    e.model = places.link(fs::absolute(path).lexically_normal());
    const fs::path header = places.generated / e.domain / header_name(system.scene);
    if (fs::exists(header)) e.header = places.link(header);
    e.picture = places.link(places.generated / "gallery" / (e.name + ".svg"));
    return made;
}

GalleryRun run_entry(const GalleryMachine& entry) {
    GalleryRun result;
    if (!entry.simulation) return {small_text("No run: everything is at rest."), "", true, 0};
    const PreparedSimulation& simulation = *entry.simulation;
    const PlantLibrary library(simulation.plant, simulation.cache);
    const PlantRunResult run = simulate_plant(library.table(), simulation.run);
    Panel panel;
    if (!simulation.settings.plots.empty()) {
        const Plot& plot = simulation.settings.plots.front();
        panel = {plot.title, plot.x, plot.y};
    }
    result.picture = small_plot(for_plots(run.recording, simulation.units), panel);
    result.stiff_steps = simulation.run.method == "automatic" ? run.outcome.steps_by.back() : 0;
    result.status = to_string(run.outcome.status);
    result.is_good = run.outcome.status == Status::success || run.outcome.status == Status::event;
    return result;
}

}  // namespace

ExitCode gallery_command(const Options& options, Streams streams) {
    const GalleryPlaces places(options);
    std::vector<GalleryMachine> machines;
    for (const std::string& path : options.models) {
        machines.push_back(prepare_entry(path, places, options, streams));
        streams.err << fmt::format("  {}: derived, proven, checked\n", machines.back().entry.name);
    }
    GalleryResult result{{}, options.output, {}};
    bool failed = false, stopped = false;
    in_parallel(
        machines.size(), [&](std::size_t i) { return run_entry(machines[i]); },
        [&](std::size_t i, const GalleryRun& run) {
            GalleryMachine& made = machines[i];
            made.entry.shows = traits_of({*made.derived().system, made.entry.printed, find_run(made.model->model, ""), run.stiff_steps});
            result.pictures.emplace_back(fs::path(options.generated.empty() ? options.output : options.generated) / "gallery" /
                                             (made.entry.name + ".svg"), run.picture);
            streams.err << fmt::format("  [{:>2}/{}] {}: run{}\n", i + 1, machines.size(), made.entry.name,
                                       run.is_good ? "" : ", which stopped: " + run.status);
            failed = failed || made.failed;
            stopped = stopped || !run.is_good;
            result.entries.push_back(made.entry);
        });
    FileContents files = result.pictures;
    files.emplace_back(result.folder / "gallery.html", gallery_page(result));
    files.emplace_back(result.folder / "GALLERY.md", gallery_markdown(result));
    write_files(files);
    streams.out << as_text(result);
    return failed ? ExitCode::check_failed : stopped ? ExitCode::run_stopped : ExitCode::good;
}

}  // namespace dalembert
