// PilotRun.h - a run of a pilot protocol: its study, the session that is begun or continued, and the protocol's run on
// a bench for the participant. Command line and window use this to run sessions.
//
// Checks every gate before making or presenting anything (core/study/Gates.h, MachineGate.h, core/pilot/PilotCare.h).
//
// Thread-safety: as ProtocolRun.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/run/MarkerServer.h"
#include "app/run/OpenedStudy.h"
#include "app/run/PilotOrder.h"
#include "app/run/ProtocolRun.h"
#include "app/run/UnfinishedSession.h"
#include "core/pilot/PilotSession.h"
#include "core/pilot/VirtualPilotParticipant.h"
#include "core/study/Study.h"

namespace tacto {

class PilotRun {
public:
    /// The settings of `order` hold the participant, `unfinished` and the rest. If `pilot.study` has no study and the
    /// participant is virtual, a rehearsal is made there.
    /// Errors: NotFound for a study, code or passphrase that cannot be used, a person without a window, and an
    /// unfinished session that the settings do not mention; Stopped for a gate; as MarkerServer::listen(), which is
    /// checked first, and ProtocolRun::prepare().
    [[nodiscard]] static Result<std::unique_ptr<PilotRun>> prepare(RunOrder order, PilotOrder pilot, Registry& registry,
                                                                   std::shared_ptr<BenchTap> tap = nullptr);
    ~PilotRun();
    PilotRun(const PilotRun&) = delete;
    PilotRun& operator=(const PilotRun&) = delete;

    /// As ProtocolRun::start().
    [[nodiscard]] Result<void> start(RunRequest hooks);
    /// Ends like ProtocolRun::finish(). The session's last row states what happened to the markers; then the ledger
    /// records how the session ended.
    [[nodiscard]] RunResult finish();

    [[nodiscard]] ProtocolRun& run() noexcept { return *run_; }
    [[nodiscard]] PilotSession& session() noexcept { return *session_; }
    [[nodiscard]] const Study& study() const noexcept { return study_; }
    /// Actions taken automatically, one sentence each: a rehearsal made, a participant enrolled, a session ended.
    [[nodiscard]] const std::vector<std::string>& remarks() const noexcept { return remarks_; }

private:
    PilotRun(OpenedStudy opened, std::shared_ptr<MarkerServer> markers);
    void cancelBooked();
    [[nodiscard]] Result<void> mayGoOn() const;
    [[nodiscard]] Result<void> noteSkin(const std::string& moment, int score);
    [[nodiscard]] std::optional<MarkerTally> endMarkers();
    void fitOrder(RunOrder& order, const PilotOrder& pilot);
    [[nodiscard]] Result<void> chooseWords(std::string language, const std::filesystem::path& folder);
    [[nodiscard]] Result<RunSession> makeSession(const SessionAbout& about, const Clock& clock,
                                                 const DeviceSet& devices);

    Study study_;
    Participant who_;
    UnfinishedSession unfinished_;
    std::optional<BegunSession> begun_;
    SessionRequest request_;
    PilotSettings settings_;
    std::vector<std::string> remarks_;

    std::shared_ptr<MarkerServer> markers_;  // null: no markers are sent
    std::unique_ptr<VirtualPilotParticipant> virtual_;
    std::unique_ptr<ProtocolRun> run_;
    std::unique_ptr<PilotRecord> record_;  // the script writes to it, so the script ends first: see ~PilotRun
    std::unique_ptr<PilotSession> session_;
};

}  // namespace tacto
