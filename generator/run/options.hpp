// SPDX-License-Identifier: GPL-3.0-or-later
// What a call of the program asks for, and where it writes.
#pragma once

#include <iosfwd>
#include <map>
#include <string>
#include <vector>

#include "pipeline.hpp"

namespace dalembert {

struct Options {
    std::string verb;
    Choice choice;
    std::vector<std::string> models;      ///< of survey, cost and check
    bool every_scene = false;
    std::string format = "text";
    std::string output;                   ///< folder
    std::string pages;                    ///< of check: folder of pages, or none
    std::string generated;                ///< of gallery: folder of headers and pictures, if not that of the pages
    std::string header;                   ///< file name of the header, if not the usual one
    std::vector<std::string> parameters;  ///< "m_W=1.2,g=9.81"
    std::vector<std::string> parameter_files;
    std::vector<std::string> states;
    std::vector<std::string> inputs;
    std::vector<std::string> data;        ///< of identify: files
    std::string fit;                      ///< "d_R, start(phi)"
    std::vector<std::string> measured;    ///< columns of data that are compared; all, if empty
    std::vector<std::string> noise;       ///< of columns: "phi=0.2deg"
    std::vector<std::string> held_inputs; ///< of data, that keep each value up to the next
    std::vector<std::string> priors;      ///< "d_R=normal(0.3, 5 %)"
    std::string loss = "none";
    int starts = 1;
    std::vector<std::string> measured_inputs;  ///< that data give
    std::string mode;                     ///< of a machine that switches; empty: the first
    int digits = 17;
    std::string time;  ///< of evaluate; empty: 0
    std::string run;
    std::string until;
    double tolerance = 0;                 ///< 0: as the run says
    std::string method;
    double step = 0;
    int samples = 0;
    double periods = 0;                   ///< length of the run in periods, where the run names one
    bool no_plot = false;
    std::vector<std::string> sensitivities;  ///< what a run is differentiated by
    bool second_order = false;            ///< and again
    std::vector<std::string> write;       ///< formats of results besides CSV
    bool no_cache = false;                ///< plants are compiled anew
    std::string units;                    ///< "declared" or "si", of CSV and plots; empty: CSV in SI, plots in declared units
    bool compares_scenes = false;         ///< a run counts for every scene
    std::string against;                  ///< the scene that others are compared with; the fullest, if empty
    std::string maximise, minimise;       ///< what optimise looks for
    std::string over;                     ///< "alpha=10deg:80deg"
    int points = 33;                      ///< of its scan
    std::vector<std::string> vary;        ///< of study: "m_W=normal(1, 5 %), d_R=0.1:1:10"
    std::vector<std::string> observe;     ///< "max(phi), end(s)"
    std::uint64_t runs = 0;
    std::string sampling;                 ///< "random" or "sobol"; empty: as fits
    bool indices = false;                 ///< Sobol indices
    int jobs = 0;                         ///< threads; 0: one a processor
    std::string shard;                    ///< "2/3"
    std::vector<std::string> merge;       ///< files of shards
    std::string only;                     ///< the number of a run that is made again
    int worst = 3;                        ///< runs at either end that are told
    std::string budget;                   ///< "1 ms step, 20 us"
    std::vector<std::string> methods;     ///< that cost measures; all, if empty
    std::vector<std::string> arithmetics;
    double limit = 5;                     ///< s, of one run that cost measures
    std::map<std::string, std::vector<int>> size_lists;  ///< of cost: every size is measured
    std::vector<std::string> hold;
    std::vector<std::string> moving;      ///< coordinates
    std::vector<std::string> free;
    bool taylor = false;                  ///< the header gets series
    std::map<Function, bool> wished;      ///< of the functions that headers have where they are asked for
    bool explain = false;
    std::string dump;
    std::string topic;                    ///< of help
    std::string project;                  ///< of new: its name
    std::string kind;                     ///< and its kind
    int test_points = 2000;               ///< of accuracy, in each arithmetic
    std::uint64_t seed = 1;
    std::vector<std::string> without;     ///< names of passes
    std::string fix;                      ///< parameters that become numbers
    std::string language = languages().front().name;
    std::string target;                   ///< of export
    int port = 8123;                      ///< of watch; 0: any that is free
    bool sources_only = false;
    std::string trig = "library";         ///< whose sine and cosine the header calls
    double ulp_limit = 8;                 ///< of errors in double
};

/// Where a verb writes.
struct Streams {
    std::ostream& out;
    std::ostream& err;
};

}  // namespace dalembert
