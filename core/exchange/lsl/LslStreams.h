// LslStreams.h - a session on the Lab Streaming Layer while it runs: three outlets that other programs record, and one
// stream of theirs whose texts become notes of the session.
//
// Outlets: Tactoscope-markers (text), Tactoscope-frames (roughness frames) and Tactoscope-trains (what was commanded
// and delivered, and from which R and P), channels and values as an XDF export of the session has them; a sample's
// stamp is the time in the session's row, on liblsl's clock. A pilot session has markers alone, of what PilotRecord
// calls them: trains would tell an operator who is blind (hazard H9), and anybody on the network, what a participant
// feels.
//
// Promise (hazard H2): nothing waits for LSL. A session is heard where it writes its rows (SessionListener.h), which is
// not the control loop's thread; what is heard waits in a queue of kMaxWaiting, and one more is dropped and counted.
// liblsl is called by two threads of this object's own. Should the library not return from a call when the session has
// ended, end() leaves the thread to it and says so.
//
// Who may listen: liblsl opens ports and answers on the network as its own settings say (lsl_api.cfg).
//
// Thread-safety: begin() and end() have one caller; the others: any thread.
#pragma once

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "core/exchange/lsl/LslNotes.h"
#include "core/session/SessionListener.h"

namespace tacto {

class SessionWriter;

/// What a session sends and takes by LSL.
struct LslOrder {
    bool outlets = false;
    std::string markers{};  ///< name of another program's stream of markers; empty: none is taken
    [[nodiscard]] bool wanted() const noexcept { return outlets || !markers.empty(); }
    bool operator==(const LslOrder&) const = default;
};

struct LslTally {
    LslOrder order;
    std::uint64_t markers = 0, frames = 0, trains = 0;  ///< handed to liblsl
    std::uint64_t unheard = 0;                          ///< of these, while nobody listened
    std::uint64_t dropped = 0;                          ///< liblsl was slower than the session
    std::uint64_t refused = 0;                          ///< liblsl returned an error
    std::uint64_t unsent = 0;                           ///< waited when it did not return at the end
    LslNoteTally notes;
    bool hung = false;  ///< liblsl did not return at the end
    bool operator==(const LslTally&) const = default;
};
[[nodiscard]] nlohmann::json toJson(const LslTally& tally);
/// Returns "LSL: 12 markers, 3401 frames and 79 trains were sent, and nothing was lost.", or what was lost.
[[nodiscard]] std::string lslSentence(const LslTally& tally);

class LslStreams final : public SessionListener {
public:
    static constexpr std::size_t kMaxWaiting = 4096;

    /// Loads the library; nothing is sent yet. `markersOnly`: for a pilot session. Errors: as LslNotes::checkName() and
    /// LslLibrary::load().
    [[nodiscard]] static Result<std::shared_ptr<LslStreams>> prepare(LslOrder order, bool markersOnly);
    /// Calls end().
    ~LslStreams() override;
    LslStreams(const LslStreams&) = delete;
    LslStreams& operator=(const LslStreams&) = delete;

    /// Opens the outlets and looks for the stream of markers. `session`, which is heard since before its first stream,
    /// records the notes; it must outlive end(). `name`: of the session. Its clock is not virtual. Blocks until liblsl
    /// has opened the outlets, at most 5 s. Errors: Device if liblsl refuses; Timeout if it does not return; as
    /// LslClock::match().
    [[nodiscard]] Result<void> begin(SessionWriter& session, const SessionAbout& about, std::string_view name,
                                     std::shared_ptr<const Clock> clock);
    /// Sends a marker that is no row of a session without a participant. Returns at once.
    void marker(Instant at, std::string_view text) noexcept;
    /// Sends what waits, gives recorders 0.2 s to take it, closes the streams and returns what became of them. Blocks
    /// for at most 3 s, whatever the library does. Nothing is sent or noted afterwards.
    LslTally end();

    void onStream(int id, const SessionStream& stream) noexcept override;
    void onSamples(int stream, const SampleBlock& block) noexcept override;
    void onCommand(const SessionRow& command) noexcept override;
    void onEvent(const SessionRow& event) noexcept override;
    void onTrial(const SessionTrial& trial) noexcept override;

private:
    struct State;
    explicit LslStreams(std::shared_ptr<State> state);
    const std::shared_ptr<State> state_;  // shared with threads that liblsl may hold
};

}  // namespace tacto
