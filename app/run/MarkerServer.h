// MarkerServer.h - the markers of a pilot session for EEG and EMG recorders: a line of text for each event, over TCP.
//
// The program listens and recorders connect (resources/design/pilot.md, section 5). A line is "NUMBER TIME NAME\n" in
// ASCII: the number of the marker from 1, without holes where none was lost; the time that the session's record states
// for it, in seconds of the session's clock with nine decimals; the kind of its row. The first line that a recorder
// gets is named "connected": the number of the last marker before, and the time at which the line was made. What a
// recorder sends is not read.
//
// Promise (hazard H2): nothing waits for a recorder. What one does not take (kBacklog bytes wait for it) is lost for
// it, and counted. "Taken" is by the operating system: what it still holds when a recorder vanishes is not known.
//
// Thread-safety: send() from any thread; the others have one caller. Recorders are served by a thread of its own.
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
    std::string host = "127.0.0.1";  ///< this computer's; others reach the usual one from this computer alone
    std::uint16_t port = 0;

    static constexpr std::uint16_t kMinPort = 1024;
    /// "5005", "192.168.1.20:5005", "[::1]:5005". Errors: InvalidArgument with what was given and what is accepted.
    [[nodiscard]] static Result<MarkerAddress> parse(std::string_view text);
    [[nodiscard]] std::string text() const;  ///< "127.0.0.1:5005", "[::1]:5005"
    bool operator==(const MarkerAddress&) const = default;
};

/// How many markers were sent, and what became of them.
struct MarkerTally {
    std::uint64_t made = 0;
    std::uint64_t unheard = 0;    ///< those of them that reached no recorder
    std::uint64_t lost = 0;       ///< lines that a recorder did not take while it was connected
    std::uint64_t recorders = 0;  ///< connections, one after the other too
    bool operator==(const MarkerTally&) const = default;
};
[[nodiscard]] nlohmann::json toJson(const MarkerTally& tally);  ///< made, unheard, lost, recorders
/// "516 markers were made; a recorder connected once, and none was lost.", or what was.
[[nodiscard]] std::string markersSentence(const MarkerTally& tally);

class MarkerServer {
public:
    static constexpr std::size_t kMaxRecorders = 8;  ///< a further recorder is hung up on
    static constexpr std::int64_t kBacklog = 65536;  ///< bytes that wait for one recorder

    /// Recorders can connect from now on. Errors: Io where the port is taken or the address is not this computer's.
    [[nodiscard]] static Result<std::unique_ptr<MarkerServer>> listen(const MarkerAddress& at);
    /// Ends as end() does.
    ~MarkerServer();
    MarkerServer(const MarkerServer&) = delete;
    MarkerServer& operator=(const MarkerServer&) = delete;

    /// Recorders get their first line now, and those that connect later theirs then.
    void begin(std::shared_ptr<const Clock> clock);
    /// The marker of a row that is on disk. `name`: ASCII without spaces. Returns at once; nothing after end().
    void send(Instant at, std::string_view name);
    /// Gives the recorders at most 0.2 s for what they have not taken, hangs up and says what became of all markers.
    MarkerTally end();

private:
    struct State;
    explicit MarkerServer(std::unique_ptr<State> state);
    const std::unique_ptr<State> state_;
};

}  // namespace tacto
