// SPDX-License-Identifier: GPL-3.0-or-later
#define servo_control_full_real float
#include "servo_control_full.h"

float sample_of_controller(const float* measured);

float sample_of_controller(const float* measured) {
    static servo_control_full controller;
    static float states[servo_control_full_state_count];
    static bool is_ready = false;
    float set[servo_control_full_output_count];
    if (!is_ready) {
        const servo_control_full_parameters parameters = servo_control_full_default_parameters();
        servo_control_full_update(&controller, &parameters);
        servo_control_full_start_state(&controller, states);
        is_ready = true;
    }
    servo_control_full_sample(&controller, measured, states, set);
    return set[0];
}
