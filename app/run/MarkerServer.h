// MarkerServer.h - sends the markers of a pilot session to EEG and EMG recorders: one line of text per event, over TCP.
//
// The program listens and recorders connect (resources/design/pilot.md, section 5). A line is "NUMBER TIME NAME\n" in
// ASCII. NUMBER counts markers from 1, without gaps unless one was lost; TIME is the time of the session's record, in
// seconds of the session's clock with nine decimals; NAME is the kind of its row. The first line for a recorder is
// named "connected" and has the number of the previous marker and the time at which it was made. Data from a recorder
// is not read.
//
// Promise (hazard H2): nothing waits for a recorder. Up to kBacklog bytes wait for it; further lines are lost for it
// and counted. "Taken" means by the operating system: what it holds when a recorder vanishes is not known.
//
// Thread-safety: send() from any thread; the others have one caller. A separate thread serves the recorders.
#pragma once

#include <cstdint>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "core/base/Clock.h"
#include "core/base/Result.h"

namespace tacto {

/// The address at which the program listens.
struct MarkerAddress {
    std::string host = "127.0.0.1";  ///< this default address is only reachable from this computer
    std::uint16_t port = 0;

    static constexpr std::uint16_t kMinPort = 1024;
    /// Reads "5005", "192.168.1.20:5005", "[::1]:5005". Errors: InvalidArgument naming the given and the accepted text.
    [[nodiscard]] static Result<MarkerAddress> parse(std::string_view text);
    [[nodiscard]] std::string text() const;  ///< "127.0.0.1:5005", "[::1]:5005"
    bool operator==(const MarkerAddress&) const = default;
};

/// The number of markers sent, and what happened to them.
struct MarkerTally {
    std::uint64_t made = 0;
    std::uint64_t unheard = 0;    ///< markers that reached no recorder
    std::uint64_t lost = 0;       ///< lines that a connected recorder did not take
    std::uint64_t recorders = 0;  ///< number of connections, including successive ones
    bool operator==(const MarkerTally&) const = default;
};
[[nodiscard]] nlohmann::json toJson(const MarkerTally& tally);  ///< made, unheard, lost, recorders
/// Returns "516 markers were made; a recorder connected once, and none was lost.", or what was lost.
[[nodiscard]] std::string markersSentence(const MarkerTally& tally);

class MarkerServer {
public:
    static constexpr std::size_t kMaxRecorders = 8;  ///< further recorders are disconnected
    static constexpr std::int64_t kBacklog = 65536;  ///< bytes that may wait for one recorder

    /// Accepts recorders from now on. Errors: Io if the port is in use or the address is not this computer's.
    [[nodiscard]] static Result<std::unique_ptr<MarkerServer>> listen(const MarkerAddress& at);
    /// Calls end().
    ~MarkerServer();
    MarkerServer(const MarkerServer&) = delete;
    MarkerServer& operator=(const MarkerServer&) = delete;

    /// Sends recorders their first line: now, or when they connect later.
    void begin(std::shared_ptr<const Clock> clock);
    /// Sends the marker of a row that is on disk. `name`: ASCII without spaces. Returns at once; nothing after end().
    void send(Instant at, std::string_view name);
    /// Gives recorders at most 0.2 s to take waiting lines, disconnects them and returns the tally of all markers.
    MarkerTally end();

private:
    struct State;
    explicit MarkerServer(std::unique_ptr<State> state);
    const std::unique_ptr<State> state_;
};

}  // namespace tacto
