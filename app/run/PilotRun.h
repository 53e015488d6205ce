// PilotRun.h - a run of a pilot protocol: the study it belongs to, the session that is begun or continued, and the
// protocol's run on a bench for that participant. Command line and window run sessions through this.
//
// Every gate is asked before anything is made or presented (core/study/Gates.h, MachineGate.h, core/pilot/PilotCare.h).
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
    /// The participant, `unfinished` and the rest are settings of `order`. Where `pilot.study` holds no study and the
    /// participant is virtual, a rehearsal is made there.
    /// Errors: NotFound for a study, code or passphrase that cannot be used, a person without a window, and an
    /// unfinished session that the settings say nothing of; Stopped for a gate; as MarkerServer::listen(), before
    /// anything else is looked at, and ProtocolRun::prepare().
    [[nodiscard]] static Result<std::unique_ptr<PilotRun>> prepare(RunOrder order, PilotOrder pilot, Registry& registry,
                                                                   std::shared_ptr<BenchTap> tap = nullptr);
    ~PilotRun();
    PilotRun(const PilotRun&) = delete;
    PilotRun& operator=(const PilotRun&) = delete;

    /// As ProtocolRun::start().
    [[nodiscard]] Result<void> start(RunRequest hooks);
    /// Ends like ProtocolRun::finish(), with the session's last row saying what became of the markers; then the ledger
    /// says how the session ended.
    [[nodiscard]] RunResult finish();

    [[nodiscard]] ProtocolRun& run() noexcept { return *run_; }
    [[nodiscard]] PilotSession& session() noexcept { return *session_; }
    [[nodiscard]] const Study& study() const noexcept { return study_; }
    /// Actions taken without being asked, a sentence each: a rehearsal made, a participant enrolled, a session ended.
    [[nodiscard]] const std::vector<std::string>& remarks() const noexcept { return remarks_; }

private:
    PilotRun(OpenedStudy opened, std::shared_ptr<MarkerServer> markers);
    void cancelBooked();
    [[nodiscard]] Result<void> mayGoOn() const;
    [[nodiscard]] Result<void> noteSkin(const std::string& moment, int score);
    [[nodiscard]] std::optional<MarkerTally> endMarkers();
    void fitOrder(RunOrder& order, const PilotOrder& pilot);
    [[nodiscard]] Result<RunSession> makeSession(const SessionAbout& about, const Clock& clock,
                                                 const DeviceSet& devices);

    Study study_;
    Participant who_;
    UnfinishedSession unfinished_;
    std::optional<BegunSession> begun_;
    SessionRequest request_;
    PilotSettings settings_;
    std::vector<std::string> remarks_;

    std::shared_ptr<MarkerServer> markers_;  // null: none are sent
    std::unique_ptr<VirtualPilotParticipant> virtual_;
    std::unique_ptr<ProtocolRun> run_;
    std::unique_ptr<PilotRecord> record_;  // Written to by the script: ends after it, see ~PilotRun
    std::unique_ptr<PilotSession> session_;
};

}  // namespace tacto
