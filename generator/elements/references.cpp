// SPDX-License-Identifier: GPL-3.0-or-later
#include "elements/references.hpp"

#include "elements/every_kind.hpp"
#include "elements/kinds.hpp"

namespace dalembert {

namespace {

class ReferenceWalk {
public:
    explicit ReferenceWalk(const ReferenceVisitor& take) : take_(take) {}

    template <class Other>
    void operator()(const char*, const Other&, const Key&) const {}
    void operator()(const char* name, const Reference& reference, const Key& key) const {
        if (!reference.name.empty()) take_({reference, name, key.refers, key.all_members});
    }
    void operator()(const char* name, const std::optional<Reference>& reference, const Key& key) const {
        if (reference) (*this)(name, *reference, key);
    }
    void operator()(const char* name, const std::vector<Reference>& references, const Key& key) const {
        for (const Reference& reference : references) (*this)(name, reference, key);
    }
    void operator()(const char* name, const CoordinateEntry& entry, const Key&) const {
        if (!entry.coordinate.empty()) take_({{entry.coordinate, entry.index, entry.span}, name, {"coordinate"}, false});
    }
    void operator()(const char* name, const std::vector<CoordinateEntry>& entries, const Key& key) const {
        for (const CoordinateEntry& entry : entries) (*this)(name, entry, key);
    }

    template <class Value>
    void choice(const char*, const Value&, const Key&, const KeyChoices<Value>&) const {}
    template <class One, class Other>
    void alternatives(const char*, const One&, const Other&, const Key&) const {}
    void either(const char*, const char*, const char*) const {}
    void by_hand(const char*, const Key&) const {}
    void item(const ItemKeys&) const {}
    template <class Part>
    void table(const char*, const std::optional<Part>& part, const Key&) const {
        if (part) describe(*this, *part);
    }
    template <class Part>
    void list(const char*, const std::vector<Part>& parts, const Key&) const {
        for (const Part& part : parts) describe(*this, part);
    }
    template <class Part>
    void named(const char* name, const std::vector<Part>& parts, const Key& key) const { list(name, parts, key); }
    template <class Of>
    std::optional<Dimension> dimension_of(const Of&) const { return std::nullopt; }

private:
    const ReferenceVisitor& take_;
};

}  // namespace

template <class Described>
void visit_references(const Described& item, const ReferenceVisitor& visitor) {
    const ReferenceWalk walk(visitor);
    describe(walk, item);
}

#define DALEMBERT_VISIT(section, member, Type) template void visit_references(const Type& item, const ReferenceVisitor& visitor);
DALEMBERT_KINDS(DALEMBERT_VISIT)
#undef DALEMBERT_VISIT

}  // namespace dalembert
