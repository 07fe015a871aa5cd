// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/derive.hpp"

#include "command/write_result.hpp"
#include "run/shared.hpp"

namespace dalembert {

ExitCode derive_command(const Options& options, Streams streams) {
    write_result(DeriveResult{derived(options, streams)}, options, streams);
    return ExitCode::good;
}

}  // namespace dalembert
