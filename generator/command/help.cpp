// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <ostream>

#include "command/installed_texts.hpp"
#include "command/verb_page.hpp"
#include "reference/pages.hpp"
#include "run/options.hpp"
#include "text/files.hpp"
#include "text/nearest.hpp"

namespace dalembert {

namespace {

Pages reference_pages() {
    Pages pages = language_pages();
    const Page more[]{function_page(), quantity_page(), unit_page(),  verb_page(),
                      error_page(),    limit_page(),    json_page(),  catalogue_page()};
    pages.insert(pages.end(), std::begin(more), std::end(more));
    return pages;
}

/// The page that leads to the others.
Page index_page(const Pages& pages) {
    Page index{"README", "Reference",
               "The program writes these pages from the tables that it works with. `dalembert help TOPIC` prints a page, or the entries "
               "for one word: a section, key, function, quantity, unit, verb, option, error or JSON field. `--format markdown` and "
               "`--format html` give other formats.",
               {}};
    Section list{"Pages", {}, {}, "Page"};
    for (const Page& page : pages) list.rows.push_back({page.name, {}, {}, page.title});
    list.docs_are = "About";
    list.rows_are_pages = true;
    index.sections.push_back(std::move(list));
    return index;
}

FileContents files(const Pages& pages, const Options& options) {
    const std::filesystem::path folder = options.pages;
    if (options.format == "html") return {{folder / "reference.html", as_html(pages)}};
    FileContents made{{folder / "README.md", as_markdown(index_page(pages))}};
    for (const Page& page : pages) made.push_back({folder / (page.name + ".md"), as_markdown(page)});
    return made;
}

Pages pages_for(const Pages& all, const Options& options, Streams streams) {
    if (options.topic.empty()) return options.format == "text" ? Pages{index_page(all)} : all;
    Pages found = pages_about(all, options.topic);
    if (found.empty()) {
        const std::string hint = did_you_mean(options.topic, words_of(all));
        found = pages_mentioning(all, options.topic);
        if (!found.empty()) {
            streams.err << fmt::format("dalembert: the reference has no entry '{}'{}; these entries mention it:\n", options.topic, hint);
            return found;
        }
        throw Failure(Diagnostic{Id::bad_option, {},
                                 fmt::format("the reference has no word '{}'{}", options.topic,
                                             hint.empty() ? "; `dalembert help` lists the pages" : hint)});
    }
    return found;
}

}  // namespace

ExitCode help_command(const Options& options, Streams streams) {
    const bool is_html = options.format == "html", is_markdown = options.format == "markdown";
    if (!options.pages.empty() && !is_html && !is_markdown)
        throw Failure(Diagnostic{Id::bad_option, {}, "'--output' is for --format markdown or html; other formats are printed"});
    for (const InstalledText& text : installed_texts()) {
        if (options.format != text.format) continue;
        streams.out << text.make();
        return ExitCode::good;
    }
    const Pages pages = pages_for(reference_pages(), options, streams);
    if (!options.pages.empty()) {
        write_files(files(pages, options));
    } else if (is_html) {
        streams.out << as_html(pages);
    } else {
        for (const Page& page : pages)
            streams.out << (&page == &pages.front() ? "" : "\n") << (is_markdown ? as_markdown(page) : as_text(page));
    }
    return ExitCode::good;
}

}  // namespace dalembert
