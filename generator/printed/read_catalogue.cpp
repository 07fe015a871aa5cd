// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <set>

#include "elements/runs.hpp"
#include "elements/verdict.hpp"
#include "printed/catalogue.hpp"
#include "printed/catalogue_schema.hpp"
#include "read/entry.hpp"
#include "text/nearest.hpp"

namespace dalembert {

namespace {

constexpr int newest_catalogue = 1;

CatalogueLetter read_letter(const Entry& e, bool is_positive) {
    CatalogueLetter letter;
    e.fill(letter);
    if (e.name() == "t") e.error(Id::reserved_name, e.span(), "'t' is always the time; leave it out");
    letter.unit = e.unit("unit").value_or(Unit{});
    letter.range = e.range("range", letter.unit);
    letter.value = e.constant("value", letter.unit);
    letter.is_positive = is_positive;
    letter.moves = e.has("of");
    if (letter.moves && e.text("of") != "t")
        e.error(Id::wrong_type, e.span_of("of"),
                fmt::format("'{}' is not the time: a letter is a function of 't' or of nothing", e.text("of")));
    if (letter.moves && letter.value)
        e.error(Id::unknown_key, e.span_of("value"), fmt::format("'{}' is a function of time, so it is not a number", e.name()));
    return letter;
}

std::vector<PrintedLetter> read_with(const Entry& e, std::string_view key) {
    std::vector<PrintedLetter> letters;
    for (const RunEntry& letter : e.by_name(key)) {
        if (letter.variable->kind == Expression::Kind::name && letter.variable->children.empty())
            letters.push_back({letter.variable->name, letter.value, letter.span});
        else e.error(Id::bad_name, letter.span, fmt::format("'{}' is not a letter", letter.variable->written()));
    }
    return letters;
}

CatalogueEntry read_entry(const Entry& e) {
    CatalogueEntry entry;
    e.fill(entry);
    entry.source = e.text("source");
    entry.equations = e.has("equations") ? e.equations("equations") : e.equations("equation");
    entry.latex = e.excerpt("latex");
    for (auto& [letter, value] : e.by_text("notation")) entry.notation.push_back({letter, value});
    entry.functions = e.excerpts("functions");
    entry.model = e.text("model");
    entry.model_span = e.span_of("model");
    entry.printed = e.text("printed");
    entry.scene = e.text("scene");
    entry.scene_span = e.has("scene") ? e.span_of("scene") : entry.model_span;
    entry.mode = e.text("mode");
    entry.letters = read_with(e, "with");
    entry.solved = e.equations("solves");
    entry.number_unit = e.unit("unit");
    entry.not_checkable = e.text("not_checkable");
    entry.is_dimensionless = e.boolean("dimensionless");
    if (entry.is_dimensionless && !entry.model.empty())
        e.error(
            Id::not_allowed_here, e.span_of("dimensionless"),
            fmt::format(
                "entry '{}' is checked against a model, whose quantities have units; write those of the equation, or leave the model out",
                e.name()));
    for (const RunEntry& point : e.by_name("at")) entry.at.push_back({point.variable, point.value});
    for (const bool is_positive : {false, true})
        e.each_named(is_positive ? "positive" : "letters", catalogue_section("letters"),
                     [&](const Entry& letter) { entry.own.push_back(read_letter(letter, is_positive)); });
    const auto given = [&](std::initializer_list<const char*> keys) {
        return std::count_if(keys.begin(), keys.end(), [&](const char* key) { return e.has(key); });
    };
    if (const auto ways = given({"equation", "equations", "latex", "printed", "not_checkable"});
        ways > 1 || (ways == 0 && entry.model.empty()))
        e.error(ways > 1 ? Id::doubly_defined : Id::missing_key, e.span(),
                fmt::format("entry '{}' {} of these: an equation, a list of equations, LaTeX, a model that has it printed, or a reason why "
                            "it is not checkable",
                            e.name(), ways > 1 ? "has several, and needs one" : "needs one"));
    for (const char* key : {"printed", "scene", "mode"})
        if (e.has(key) && entry.model.empty())
            e.error(Id::missing_key, e.span_of(key), fmt::format("entry '{}' has a {} but no model", e.name(), key));
    if (e.has("expect")) {
        entry.expected = read_verdict(e.text("expect"));
        if (!entry.expected)
            e.error(Id::wrong_type, e.span_of("expect"),
                    fmt::format("'{}' is not a verdict; the verdicts are {}", e.text("expect"),
                                quoted_list({verdict_names.begin(), verdict_names.end()})));
    }
    return entry;
}

class CatalogueReader {
public:
    CatalogueReader(const SourcePtr& source, Diagnostics& diagnostics) : root_(parse_document(source)), diagnostics_(diagnostics) {
        catalogue_.source = source;
    }

    Catalogue read_all() {
        header();
        std::vector<std::string> known;
        for (const SectionSpec& section : catalogue_sections()) known.emplace_back(section.name);
        for (const DocumentNode::Member& member : root_.members)
            if (std::find(known.begin(), known.end(), member.key) == known.end())
                diagnostics_.error(Id::unknown_key, member.key_span,
                                   fmt::format("a catalogue has no section [{}]{}", member.key, did_you_mean(member.key, known)));
        for (const bool is_positive : {false, true})
            each(is_positive ? "positive" : "letters", [&](const Entry& e) { catalogue_.letters.push_back(read_letter(e, is_positive)); });
        each("notation", [&](const Entry& e) {
            if (ExpressionPtr value = e.expression("value")) catalogue_.notation.push_back({e.name_excerpt(), std::move(value)});
        });
        each("macros", [&](const Entry& e) { catalogue_.macros.emplace_back(e.name_excerpt(), e.text("value")); });
        entries();
        distinct(catalogue_.letters, diagnostics_);
        return std::move(catalogue_);
    }

private:
    void header() {
        const Entry entry(*root_.find("catalogue"), catalogue_section("catalogue"), diagnostics_);
        if (const int format = entry.whole_number("format", newest_catalogue); format != newest_catalogue)
            throw Failure(Diagnostic{Id::unknown_format, entry.span_of("format"),
                                     fmt::format("the file has format {}, this program reads format {}", format, newest_catalogue)});
        catalogue_.title = entry.text("source");
        catalogue_.edition = entry.text("edition");
        catalogue_.functions = entry.excerpts("functions");
        catalogue_.preamble = entry.excerpt("preamble");
        for (const auto& [name, span] : entry.names("coordinates")) catalogue_.coordinates.push_back(name);
        is_dimensionless_ = entry.boolean("dimensionless");
        if (!entry.has("decimal")) return;
        const std::string mark = entry.text("decimal");
        if (mark == "." || mark == ",") catalogue_.decimal_mark = mark[0];
        else entry.error(Id::wrong_type, entry.span_of("decimal"), fmt::format("'{}' is no decimal mark; it is \".\" or \",\"", mark));
    }

    /// What is wrong in an entry is told with it, and takes nothing from the others.
    void entries() {
        const DocumentNode::Member* member = root_.find("entries");
        if (member == nullptr || member->value.kind != DocumentNode::Kind::table) return each("entries", [](const Entry&) {});
        for (const DocumentNode::Member& one : member->value.members) {
            Diagnostics own;
            CatalogueEntry entry;
            try {
                entry = read_entry(Entry(one, catalogue_section("entries"), own));
                distinct(entry.own, own);
            } catch (const Failure& failure) {
                for (const Diagnostic& d : failure.diagnostics()) own.error(d.id, d.span, d.message, d.notes);
            }
            if (entry.name.empty()) entry.name = one.key, entry.span = one.key_span;
            for (const Diagnostic& d : own.all())
                if (d.severity == Severity::error) entry.unreadable.push_back(d);
                else diagnostics_.warning(d.id, d.span, d.message, d.notes);
            entry.is_dimensionless = entry.is_dimensionless || (is_dimensionless_ && entry.model.empty());
            catalogue_.entries.push_back(std::move(entry));
        }
    }

    template <class Read>
    void each(const char* name, Read read) {
        const DocumentNode::Member* member = root_.find(name);
        if (member == nullptr) return;
        if (member->value.kind != DocumentNode::Kind::table) {
            diagnostics_.error(Id::wrong_type, member->key_span, fmt::format("[{}] must be a table", name));
            return;
        }
        for (const DocumentNode::Member& one : member->value.members) read(Entry(one, catalogue_section(name), diagnostics_));
    }

    static void distinct(const std::vector<CatalogueLetter>& letters, Diagnostics& diagnostics) {
        std::map<std::string, Span> seen;
        for (const CatalogueLetter& letter : letters)
            if (const auto [first, is_new] = seen.emplace(letter.name, letter.span); !is_new)
                diagnostics.error(Id::doubly_defined, letter.span, fmt::format("'{}' is defined twice", letter.name),
                                  {{first->second, fmt::format("'{}' is first defined here", letter.name)}});
    }

    DocumentNode root_;
    Diagnostics& diagnostics_;
    Catalogue catalogue_;
    bool is_dimensionless_ = false;
};

}  // namespace

bool is_catalogue(const SourcePtr& source) { return parse_document(source).find("catalogue") != nullptr; }

Catalogue read_catalogue(const SourcePtr& source, Diagnostics& diagnostics) {
    Catalogue catalogue = CatalogueReader(source, diagnostics).read_all();
    diagnostics.stop_on_errors();
    return catalogue;
}

}  // namespace dalembert
