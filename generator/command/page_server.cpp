// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/page_server.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "text/diagnostic.hpp"

namespace dalembert {

namespace {

constexpr std::size_t most_callers = 64, longest_request = 16384;
constexpr int patience = 100;  // ms, after which versions are looked at

}  // namespace

PageServer::PageServer(int port) {
    listener_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    const int yes = 1;
    if (listener_ >= 0) ::setsockopt(listener_, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    sockaddr_in place{};
    place.sin_family = AF_INET;
    place.sin_port = htons(static_cast<std::uint16_t>(port));
    place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof place;
    if (listener_ < 0 || ::bind(listener_, reinterpret_cast<const sockaddr*>(&place), size) != 0 || ::listen(listener_, 16) != 0 ||
        ::getsockname(listener_, reinterpret_cast<sockaddr*>(&place), &size) != 0) {
        const int error = errno;
        if (listener_ >= 0) ::close(listener_);
        const char* hint = error == EADDRINUSE ? "another program uses it already; give another one with --port, or 0 for any that is free"
                                               : std::strerror(error);
        throw Failure(Diagnostic{Id::tool_failed, {}, fmt::format("port {} of this computer cannot be listened to: {}", port, hint)},
                      ExitCode::tool_missing);
    }
    port_ = ntohs(place.sin_port);
    thread_ = std::jthread([this](const std::stop_token& stop) { serve(stop); });
}

PageServer::~PageServer() {
    thread_.request_stop();
    if (thread_.joinable()) thread_.join();
    for (const Caller& caller : callers_) ::close(caller.socket);
    ::close(listener_);
}

void PageServer::show(std::string page) {
    const std::lock_guard lock(mutex_);
    page_ = std::move(page);
    ++version_;
}

void PageServer::serve(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
        std::vector<pollfd> sockets{{listener_, POLLIN, 0}};
        for (const Caller& caller : callers_) sockets.push_back({caller.socket, POLLIN, 0});
        ::poll(sockets.data(), sockets.size(), patience);
        std::vector<Caller> rest;
        for (std::size_t i = 0; i < callers_.size(); ++i) {
            Caller& caller = callers_[i];
            bool stays = true;
            if (sockets[i + 1].revents != 0)
                stays = listen_to(caller);
            else if (caller.waits)
                stays = answer(caller);
            if (stays)
                rest.push_back(std::move(caller));
            else
                ::close(caller.socket);
        }
        callers_ = std::move(rest);
        if (sockets[0].revents != 0) accept_callers();
    }
}

void PageServer::accept_callers() {
    const int socket = ::accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC);
    if (socket < 0) return;
    const timeval patience_of_sending{5, 0};
    ::setsockopt(socket, SOL_SOCKET, SO_SNDTIMEO, &patience_of_sending, sizeof patience_of_sending);
    if (callers_.size() < most_callers)
        callers_.push_back({socket, ""});
    else
        ::close(socket);
}

bool PageServer::listen_to(Caller& caller) {
    char part[4096];
    const ssize_t count = ::recv(caller.socket, part, sizeof part, MSG_DONTWAIT);
    if (count <= 0 || caller.waits) return count < 0 && (errno == EAGAIN || errno == EINTR);
    caller.request.append(part, static_cast<std::size_t>(count));
    if (caller.request.size() > longest_request) return send_all(caller.socket, "431 Request Header Fields Too Large", "text/plain", "");
    if (caller.request.find("\r\n\r\n") == std::string::npos) return true;
    return answer(caller);
}

/// A page of elsewhere cannot make a browser ask in its name: names that lead here are not this computer's.
bool PageServer::is_meant(const std::string& request) const {
    for (const char* name : {"127.0.0.1", "localhost"})
        if (request.find(fmt::format("\r\nHost: {}:{}\r\n", name, port_)) != std::string::npos) return true;
    return false;
}

bool PageServer::answer(Caller& caller) {
    const std::string& request = caller.request;
    if (!request.starts_with("GET ")) return send_all(caller.socket, "405 Method Not Allowed", "text/plain", "GET alone is answered\n");
    if (!is_meant(request)) return send_all(caller.socket, "403 Forbidden", "text/plain", "this is another computer\n");
    const std::string path = request.substr(4, request.find(' ', 4) - 4);
    const std::string wait = "/next?";
    std::unique_lock lock(mutex_);
    if (path == "/") {
        const std::string page = page_, version = std::to_string(version_);
        lock.unlock();
        return send_all(caller.socket, "200 OK", ("text/html; charset=utf-8\r\nX-Version: " + version).c_str(), page);
    }
    if (!path.starts_with(wait)) return send_all(caller.socket, "404 Not Found", "text/plain", "there is one page, at /\n");
    caller.waits = true;
    caller.knows = std::strtoul(path.c_str() + wait.size(), nullptr, 10);
    if (caller.knows == version_) return true;
    const std::string version = std::to_string(version_);
    lock.unlock();
    return send_all(caller.socket, "200 OK", "text/plain", version + "\n");
}

/// False, as nothing comes behind it.
bool PageServer::send_all(int socket, const char* status, const char* type, const std::string& body) {
    const std::string text = fmt::format(
        "HTTP/1.1 {}\r\nContent-Type: {}\r\nContent-Length: {}\r\nCache-Control: no-store\r\nX-Content-Type-Options: nosniff\r\n"
        "Connection: close\r\n\r\n{}",
        status, type, body.size(), body);
    for (std::size_t sent = 0; sent < text.size();) {
        const ssize_t count = ::send(socket, text.data() + sent, text.size() - sent, MSG_NOSIGNAL);
        if (count <= 0 && !(count < 0 && errno == EINTR)) break;
        sent += count > 0 ? static_cast<std::size_t>(count) : 0;
    }
    return false;
}

}  // namespace dalembert
