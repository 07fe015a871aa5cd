// SPDX-License-Identifier: GPL-3.0-or-later
// The known word that a misspelt one was probably meant to be.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace dalembert {

/// The candidate with the smallest edit distance, else the first that begins with the word; empty when none is near enough to be a slip of
/// the pen.
std::string nearest(std::string_view word, const std::vector<std::string>& candidates);

/// "; did you mean 'X'?" or nothing.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates);

/// 'a', 'b' and 'c'
std::string quoted_list(const std::vector<std::string>& words);

}  // namespace dalembert
