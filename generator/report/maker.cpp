// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/maker.hpp"

#include "elements/switching.hpp"

namespace dalembert {

std::optional<Maker> maker_of(const Item& item, const Model& model) {
    std::optional<Maker> maker;
    // What an element brings has its place in the file.
    const auto look_in = [&]<class Element>(const std::vector<Element>& list) {
        for (const Element& one : list)
            if (item.is_made && one.span.source == item.span.source && one.span.begin == item.span.begin)
                maker = Maker{kind_of<Element>.word, one.name};
    };
    look_in(model.frictions);
    look_in(model.contacts);
    look_in(model.stops);
    return maker;
}

}  // namespace dalembert
