// SPDX-License-Identifier: GPL-3.0-or-later
// The result of `dalembert report`: pages of models, and where there are several a page that lists them.
#pragma once

#include "report/machine_page.hpp"

namespace dalembert {

struct ReportResult {
    struct Page : ReportedPage {
        std::string picture;  ///< SVG for the list; empty where there is none
    };
    std::vector<Page> pages;
    std::filesystem::path index;  ///< empty: of one model
};

/// A card for each page. The pages stand beside it.
std::string index_page(const ReportResult& result);

std::string as_text(const ReportResult& result);
nlohmann::ordered_json as_json(const ReportResult& result);

}  // namespace dalembert
