// SPDX-License-Identifier: GPL-3.0-or-later
// One program for all targets: the environment names the target, DALEMBERT_FUZZ_TARGET=latex.
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "fuzz/targets.hpp"

namespace {

const fuzz::Target& chosen() {
    static const fuzz::Target target = [] {
        const char* name = std::getenv("DALEMBERT_FUZZ_TARGET");
#ifdef WHOLE
        if (name == nullptr || std::string_view(name) == fuzz::whole().name) return fuzz::whole();
#endif
        if (const fuzz::Target* found = name == nullptr ? nullptr : fuzz::find(fuzz::readers(), name)) return *found;
        std::fprintf(stderr, "DALEMBERT_FUZZ_TARGET names no target\n");
        std::exit(2);
    }();
    return target;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    chosen().run(std::string(reinterpret_cast<const char*>(data), size));
    return 0;
}
