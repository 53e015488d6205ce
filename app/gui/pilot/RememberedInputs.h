// RememberedInputs.h - which game pads and foot switches were whose in the last session of a study, and what their
// buttons did. It stands in the user's settings, by the devices' identities; nothing of a person is kept.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QString>
#include <optional>

#include "app/gui/pilot/ButtonUse.h"

namespace tacto::gui {

/// `place`: the study's id, or kRehearsals. What was remembered of it before is forgotten.
void rememberInputs(const QString& place, const std::vector<SeatedDevice>& seats);
/// How this device was seated; nothing where it was not used there, or has other buttons by now. A device without a
/// serial number (ButtonDeviceInfo::hasSerial) is taken for any other of its model.
[[nodiscard]] std::optional<SeatedDevice> rememberedInput(const QString& place, const ButtonDeviceInfo& device);

inline constexpr const char* kRehearsals = "rehearsals";

}  // namespace tacto::gui
