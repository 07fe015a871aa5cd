// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/ranks.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <filesystem>
#include <future>
#include <map>
#include <set>
#include <thread>

namespace dalembert {

namespace {

enum Tag { has_work = 1, has_lines, all_done, says_farewell, may_end };

using Piece = std::array<std::uint64_t, 2>;  ///< first run, and how many

constexpr auto pause_of_writer = std::chrono::microseconds(200);
constexpr auto longest_farewell = std::chrono::seconds(5);

void rest() { std::this_thread::sleep_for(pause_of_writer); }

/// Which runs are nobody's, somebody's and written.
class Pieces {
public:
    Pieces(std::size_t first, std::size_t last, const std::function<void(const std::string&)>& take, std::size_t ranks)
        : next_(first), written_(first), last_(last), take_(take), most_ahead_(64 * ranks * runs_of_block) {}

    bool is_done() const { return written_ == last_; }

    /// Runs that nobody has. Where there are none, or too many wait for one that does not come, those that somebody has had longest: who
    /// has them may be lost.
    std::optional<Piece> take_one(bool also_of_others) {
        if (next_ < last_ && next_ < written_ + most_ahead_) {
            const Piece piece{next_, std::min(runs_of_block, last_ - next_)};
            next_ += piece[1];
            given_.push_back(piece);
            return piece;
        }
        if (!also_of_others || given_.empty()) return std::nullopt;
        const Piece piece = given_.front();
        given_.pop_front();
        given_.push_back(piece);
        return piece;
    }

    /// What was written before comes to nothing.
    void add(std::uint64_t first, std::string lines) {
        std::erase_if(given_, [&](const Piece& piece) { return piece[0] == first; });
        if (first < written_) return;
        waiting_.emplace(first, std::move(lines));
        while (!waiting_.empty() && waiting_.begin()->first == written_) {
            take_(waiting_.begin()->second);
            written_ += std::min(runs_of_block, last_ - written_);
            waiting_.erase(waiting_.begin());
        }
    }

private:
    std::size_t next_, written_, last_;
    const std::function<void(const std::string&)>& take_;
    std::size_t most_ahead_;
    std::deque<Piece> given_;
    std::map<std::uint64_t, std::string> waiting_;
};

/// Beside the program, or where an installation has it.
void* load_library() {
    std::array<char, 4096> path{};
    const ssize_t size = ::readlink("/proc/self/exe", path.data(), path.size() - 1);
    const std::filesystem::path folder =
        std::filesystem::path(std::string(path.data(), size > 0 ? static_cast<std::size_t>(size) : 0)).parent_path();
    for (const char* place : {"dalembert_mpi.so", "../lib/dalembert/dalembert_mpi.so"})
        if (void* handle = ::dlopen((folder / place).c_str(), RTLD_NOW | RTLD_GLOBAL)) return handle;
    return nullptr;
}

}  // namespace

std::unique_ptr<Ranks> Ranks::if_any() {
    const char* size = std::getenv("OMPI_COMM_WORLD_SIZE");
    if (size == nullptr || std::atoi(size) < 2) return nullptr;
    void* library = load_library();
    using Begin = DalembertMessages (*)();
    const auto begin = library == nullptr ? nullptr : reinterpret_cast<Begin>(::dlsym(library, "dalembert_messages"));
    if (begin == nullptr)
        throw Failure(
            Diagnostic{Id::tool_failed,
                       {},
                       "mpirun has started this program several times, but it was built without MPI; build it where CMake finds MPI "
                       "(on Debian: apt-get install libopenmpi-dev), or start it without mpirun, with --jobs or --shard"},
            ExitCode::tool_missing);
    return std::unique_ptr<Ranks>(new Ranks(begin()));
}

Ranks::~Ranks() {
    int from = 0, tag = 0;
    const char* data = nullptr;
    bool is_complete = true;
    if (is_writer()) {
        for (int rank = 1; rank < messages_.size; ++rank) messages_.send(rank, all_done, "", 0);
        int left = messages_.size - 1;
        const auto start = std::chrono::steady_clock::now();
        while (left > 0 && std::chrono::steady_clock::now() - start < longest_farewell) {
            if (messages_.receive(&from, &tag, &data) < 0)
                rest();
            else if (tag == says_farewell)
                --left;
        }
        is_complete = left == 0;
        for (int rank = 1; rank < messages_.size; ++rank) messages_.send(rank, may_end, is_complete ? "1" : "0", 1);
    } else {
        for (; !is_told_; is_told_ = is_told_ || tag == all_done)
            if (messages_.receive(&from, &tag, &data) < 0) rest();
        messages_.send(0, says_farewell, "", 0);
        for (tag = 0; tag != may_end;)
            if (messages_.receive(&from, &tag, &data) < 0) rest();
        is_complete = *data == '1';
    }
    // With processes that are lost MPI would wait for ever.
    if (is_complete) messages_.end();
}

MakeRuns Ranks::maker() {
    return [this](const Study& study, std::size_t first, std::size_t last, const std::function<void(const std::string&)>& take) {
        Pieces pieces(first, last, take, static_cast<std::size_t>(messages_.size));
        std::set<int> free;
        for (int rank = 1; rank < messages_.size; ++rank) free.insert(rank);
        std::future<std::string> own;
        Piece of_own{};
        while (!pieces.is_done()) {
            bool has_moved = false;
            if (own.valid() && own.wait_for(std::chrono::seconds(0)) == std::future_status::ready) {
                pieces.add(of_own[0], own.get());
                has_moved = true;
            }
            int from = 0, tag = 0;
            const char* data = nullptr;
            for (std::ptrdiff_t size; (size = messages_.receive(&from, &tag, &data)) >= 0; has_moved = true) {
                if (tag != has_lines) continue;
                std::uint64_t run = 0;
                std::memcpy(&run, data, sizeof run);
                pieces.add(run, std::string(data + sizeof run, static_cast<std::size_t>(size) - sizeof run));
                free.insert(from);
            }
            while (!free.empty()) {
                const auto piece = pieces.take_one(false);
                if (!piece) break;
                messages_.send(*free.begin(), has_work, reinterpret_cast<const char*>(piece->data()), sizeof *piece);
                free.erase(free.begin());
            }
            if (!own.valid() && !pieces.is_done()) {
                if (const auto piece = pieces.take_one(true)) {
                    of_own = *piece;
                    own = std::async(std::launch::async, [&study, piece = of_own] { return study.lines(piece[0], piece[1]); });
                }
            }
            if (!has_moved) rest();
        }
    };
}

void Ranks::work(Study& study) {
    bool is_compiled = false;
    while (!is_told_) {
        int from = 0, tag = 0;
        const char* data = nullptr;
        const std::ptrdiff_t size = messages_.receive(&from, &tag, &data);
        if (size < 0) {
            rest();
            continue;
        }
        is_told_ = tag == all_done;
        if (tag != has_work) continue;
        Piece piece{};
        std::memcpy(piece.data(), data, sizeof piece);
        if (!is_compiled) study.compile();
        is_compiled = true;
        std::string answer(reinterpret_cast<const char*>(piece.data()), sizeof piece[0]);
        answer += study.lines(piece[0], piece[1]);
        messages_.send(0, has_lines, answer.data(), answer.size());
    }
}

}  // namespace dalembert
