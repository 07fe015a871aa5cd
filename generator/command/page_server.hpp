// SPDX-License-Identifier: GPL-3.0-or-later
// Shows one page at an address of this computer, and lets browsers wait for its next version. It answers GET alone, and nobody but programs
// of this computer.
#pragma once

#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace dalembert {

class PageServer {
public:
    /// Listens at 127.0.0.1. Port 0: any that is free. Throws Failure (tool-failed) where the port is taken.
    explicit PageServer(int port);
    PageServer(const PageServer&) = delete;
    PageServer& operator=(const PageServer&) = delete;
    ~PageServer();

    int port() const { return port_; }
    /// The next version, for which browsers wait.
    void show(std::string page);

private:
    /// A browser that asks, or that waits for a version other than one.
    struct Caller {
        int socket;
        std::string request;
        bool waits = false;
        std::size_t knows = 0;
    };
    void serve(const std::stop_token& stop);
    void accept_callers();
    /// False where the caller is done with.
    bool listen_to(Caller& caller);
    bool answer(Caller& caller);
    bool is_meant(const std::string& request) const;
    static bool send_all(int socket, const char* status, const char* type, const std::string& body);

    int listener_ = -1, port_ = 0;
    std::vector<Caller> callers_;
    std::mutex mutex_;
    std::string page_;
    std::size_t version_ = 0;
    std::jthread thread_;  // ends first
};

}  // namespace dalembert
