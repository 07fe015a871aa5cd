// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// Prints what packs gain over calls one by one.
void time_packs();
