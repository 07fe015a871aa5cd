// SPDX-License-Identifier: GPL-3.0-or-later
// The pages of the reference, from the tables that the program works with.
#pragma once

#include "reference/page.hpp"

namespace dalembert {

/// One for each domain, and before them an overview of sections, kinds of values and words for dependences.
Pages language_pages();
Page catalogue_page();
Page function_page();
Page quantity_page();
Page unit_page();
Page error_page();
Page limit_page();
Page json_page();

/// What the pages say of a word: the name of a page, of a section ("bodies"), of a row ("mass") or of both ("bodies.mass"). Of each page
/// the sections and rows with that name remain. Empty when there is none.
Pages pages_about(const Pages& pages, const std::string& word);
/// Where pages_about finds nothing: the sections and rows whose name or sentences contain the word, whatever its case.
Pages pages_mentioning(const Pages& pages, const std::string& word);
/// Every word for which there is something.
std::vector<std::string> words_of(const Pages& pages);

std::string as_text(const Page& page);
std::string as_markdown(const Page& page);
/// One page that needs nothing else.
std::string as_html(const Pages& pages);

}  // namespace dalembert
