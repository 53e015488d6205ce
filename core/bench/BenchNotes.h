// BenchNotes.h - what a bench itself writes into the session, past the recorder, whose only caller is the control loop:
// the file alone must tell how each train was made and judged.
//
// Without a session it is a null object: nothing is written, and nothing fails.
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

    /// The lines that are applied; `text`: which calibration that is, or why there is none. Empty notes nothing.
    void calibration(const KnownLines& applied, const std::string& text) const;
    /// Notes the differences of the profile. Errors: as SessionWriter::event().
    [[nodiscard]] Result<void> profile(const Profile& before, const Profile& next) const;
    /// Load range, area, limits and calibration that every train of this arming is judged by. Errors: the same.
    [[nodiscard]] Result<void> arming(const ArmRequest& request, const GateSetup& setup, const Profile& profile) const;
    /// `kind`, one of the above: a level that a participant accepted, or called too strong, and the ceiling after it.
    /// Errors: the same.
    [[nodiscard]] Result<void> level(const char* kind, const StimulusLevel& level, const StimulusLevel& ceiling) const;
    /// Last of all, since counts grow until the end. Without this event the marks of a session are not known.
    /// `calibrated`: of the stimulator, if there is one.
    void marks(const RoughnessFlags& flags, std::optional<bool> calibrated, const Profile& profile) const noexcept;

private:
    SessionWriter* session_;
    const Clock& clock_;
};

}  // namespace tacto
