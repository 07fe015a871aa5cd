// SPDX-License-Identifier: GPL-3.0-or-later
// Results of runs for other programs: MATLAB and numpy.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <dalembert/recording.hpp>

namespace dalembert {

/// A run as it is written. Names are those of the model.
struct ResultTable {
    const Recording& recording;
    struct Event {
        double t;  ///< s
        std::string name, from, to;
    };
    std::vector<Event> events;
    std::vector<std::string> modes;  ///< by the numbers in the recording; none where nothing switches
};

struct ResultFormat {
    const char* name;  ///< on the command line
    const char* doc;
    const char* suffix;  ///< of the file
    /// The bytes of the file. Throws Failure (tool-failed).
    std::string (*write)(const ResultTable& table);
};

std::span<const ResultFormat> result_formats();

/// A struct `run` with a column for each name, which is made a name of MATLAB; cells `names`, `units` and `fields` of all columns; a struct
/// `events`; and a cell `modes`. Version 5, or 7.3, which is HDF5.
std::string mat_file(const ResultTable& table, bool is_hdf5);

/// An array for each column under its name; `names` and `units` of all columns; `event_times`, `event_names`, `event_from`, `event_to`;
/// `modes`.
std::string npz_file(const ResultTable& table);

}  // namespace dalembert
