// SPDX-License-Identifier: GPL-3.0-or-later
// The result of `dalembert gallery`: many systems on one page, each with its picture, numbers and verdicts.
#pragma once

#include "report/printed_report.hpp"
#include "report/traits.hpp"
#include "text/files.hpp"

namespace dalembert {

struct GalleryEntry {
    std::string name, title, doc, source;
    std::string domain;                 ///< the folder of the model
    std::string scene;                  ///< that is shown
    std::size_t scenes = 1;             ///< there are
    std::size_t degrees = 0;            ///< of freedom, that constraints leave
    std::size_t coordinates = 0;        ///< and quasi-velocities in their place
    std::size_t states = 0;
    int operations = 0;                 ///< of the right-hand side
    std::vector<const Trait*> shows;
    VerdictCounts proofs;               ///< of all scenes
    VerdictCounts printed;
    std::string numbers;                ///< of printed equations: "2.70-2.74"; empty where they have none
    std::string model, header, picture; ///< links from the pages; no header: empty
};

/// Systems of one domain stand together.
struct GalleryResult {
    std::vector<GalleryEntry> entries;
    std::filesystem::path folder;
    FileContents pictures;

    /// The domains with the places of their entries, in the order in which they come.
    std::vector<std::pair<std::string, std::vector<const GalleryEntry*>>> domains() const;
};

/// "2.70-2.74, 2.94, 3.5": numbers within ten of each other are one range.
std::string number_ranges(const std::vector<PrintedRow>& rows);

/// "1 degree of freedom", "2 degrees of freedom, 3 coordinates"
std::string degrees_text(const GalleryEntry& entry);
/// "mechanics" as "Mechanics".
std::string domain_title(const std::string& domain);
/// What the pages say first.
std::string gallery_lead(const GalleryResult& result);

/// gallery.html: a page with sections by domain. With scripts it can be sorted and filtered.
std::string gallery_page(const GalleryResult& result);
/// GALLERY.md: tables by domain.
std::string gallery_markdown(const GalleryResult& result);

/// Which files were written.
std::string as_text(const GalleryResult& result);

}  // namespace dalembert
