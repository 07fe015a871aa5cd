// SPDX-License-Identifier: GPL-3.0-or-later
// The page of one model, for verbs that write or show it.
#pragma once

#include "report/machine_pages.hpp"
#include "run/options.hpp"

namespace dalembert {

struct MadePage {
    ReportResult::Page told;
    std::string html;
};
/// Of the model that the options choose. `with_picture`: that of its first plot, which takes a compiler. Throws Failure.
/// `watching`: a script that the page gets besides its own.
MadePage make_page(const Options& options, Streams streams, bool with_picture, const std::string& watching = {});

}  // namespace dalembert
