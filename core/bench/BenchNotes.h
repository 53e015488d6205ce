// BenchNotes.h - the records that a bench writes into the session itself, because only the control loop may call the
// recorder: the session file alone must tell how each train was made and judged.
//
// Without a session, nothing is written and nothing fails.
//
// Thread-safety: one caller, the bench's.
#pragma once

#include <optional>
#include <string>

#include "core/base/Clock.h"
#include "core/bench/Bench.h"

namespace tacto {

/// Kinds of the events that level() writes (resources/design/pilot.md, section 6).
namespace row {
inline constexpr const char* kLevelAccepted = "level-accepted";
inline constexpr const char* kLevelTooStrong = "level-too-strong";
}  // namespace row

class BenchNotes {
public:
    /// `session` and `clock` outlive the notes; `session` may be null.
    BenchNotes(SessionWriter* session, const Clock& clock) noexcept : session_(session), clock_(clock) {}

    /// Notes the calibration lines in use; `text` names the calibration or says why there is none. Empty: no note.
    void calibration(const KnownLines& applied, const std::string& text) const;
    /// Notes how the profile changes. Errors: as SessionWriter::event().
    [[nodiscard]] Result<void> profile(const Profile& before, const Profile& next) const;
    /// Notes the load range, area, limits and calibration that judge every train of this arming. Errors: as profile().
    [[nodiscard]] Result<void> arming(const ArmRequest& request, const GateSetup& setup, const Profile& profile) const;
    /// Notes a level that a participant accepted or called too strong (`kind`, see above), and the ceiling after it.
    /// Errors: as profile().
    [[nodiscard]] Result<void> level(const char* kind, const StimulusLevel& level, const StimulusLevel& ceiling) const;
    /// Called last of all, because the flags' counts grow until the end. Without this event, a session's marks are
    /// unknown. `calibrated`: whether the stimulator is calibrated; nothing without a stimulator.
    void marks(const RoughnessFlags& flags, std::optional<bool> calibrated, const Profile& profile) const noexcept;

private:
    SessionWriter* session_;
    const Clock& clock_;
};

}  // namespace tacto
