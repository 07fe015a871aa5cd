// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/process.hpp"

#include <poll.h>
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <filesystem>

#include "text/diagnostic.hpp"
#include "text/guardian.hpp"

extern char** environ;

namespace dalembert {

namespace {

/// Reads two pipes to their ends; reading one after the other could block the writer.
void read_both(int first, int second, std::string& to_first, std::string& to_second) {
    std::array<pollfd, 2> files{{{first, POLLIN, 0}, {second, POLLIN, 0}}};
    std::array<std::string*, 2> texts{&to_first, &to_second};
    int open = 2;
    while (open > 0) {
        if (poll(files.data(), files.size(), -1) < 0) {
            if (errno == EINTR) continue;
            return;
        }
        for (std::size_t i = 0; i < files.size(); ++i) {
            if (files[i].fd < 0 || files[i].revents == 0) continue;
            std::array<char, 4096> buffer;
            const ssize_t count = read(files[i].fd, buffer.data(), buffer.size());
            if (count > 0) {
                texts[i]->append(buffer.data(), static_cast<std::size_t>(count));
            } else {
                files[i].fd = -1;
                --open;
            }
        }
    }
}

/// A process group of its own, so that all that it starts can be ended with it; and none of the signals that wait for us.
class SpawnAttributes {
public:
    SpawnAttributes() {
        posix_spawnattr_init(&attributes_);
        posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK);
        posix_spawnattr_setpgroup(&attributes_, 0);
        sigset_t none;
        sigemptyset(&none);
        posix_spawnattr_setsigmask(&attributes_, &none);
    }
    ~SpawnAttributes() { posix_spawnattr_destroy(&attributes_); }
    SpawnAttributes(const SpawnAttributes&) = delete;
    SpawnAttributes& operator=(const SpawnAttributes&) = delete;
    const posix_spawnattr_t* get() const { return &attributes_; }

private:
    posix_spawnattr_t attributes_{};
};

}  // namespace

ProcessResult run_process(const std::vector<std::string>& arguments) {
    std::array<int, 2> out{};
    std::array<int, 2> err{};
    // Not inherited by what other threads start meanwhile: it would keep the pipes open.
    if (pipe2(out.data(), O_CLOEXEC) != 0 || pipe2(err.data(), O_CLOEXEC) != 0) return {127, {}, "no pipe"};
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, out[1], STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, err[1], STDERR_FILENO);
    for (const int file : {out[0], out[1], err[0], err[1]}) posix_spawn_file_actions_addclose(&actions, file);
    std::vector<char*> argv;
    for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    pid_t child = 0;
    const SpawnAttributes attributes;
    auto not_ending = Leftovers::all().hold();
    const int failed = posix_spawnp(&child, argv[0], &actions, attributes.get(), argv.data(), environ);
    if (failed == 0) Leftovers::all().add_child(child);
    not_ending.unlock();
    posix_spawn_file_actions_destroy(&actions);
    close(out[1]);
    close(err[1]);
    ProcessResult result{127, {}, {}};
    if (failed == 0) {
        read_both(out[0], err[0], result.output, result.errors);
        int status = 0;
        while (waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
        Leftovers::all().remove_child(child);
        result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    }
    close(out[0]);
    close(err[0]);
    return result;
}

ScratchFolder::ScratchFolder() {
    const auto not_ending = Leftovers::all().hold();
    std::string pattern = (std::filesystem::temp_directory_path() / "dalembert-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr)
        throw Failure(Diagnostic{Id::tool_failed, {}, "a folder for temporary files cannot be created"}, ExitCode::tool_missing);
    path_ = pattern;
    Leftovers::all().add_folder(path_);
}

ScratchFolder::~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
    Leftovers::all().remove_folder(path_);
}

}  // namespace dalembert
