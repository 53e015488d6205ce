// PilotStart.h - what a session in the window is begun with.
//
// Thread-safety: values.
#pragma once

#include <QString>
#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/gui/pilot/AnswerKeys.h"
#include "app/gui/pilot/ButtonUse.h"
#include "app/run/MarkerServer.h"
#include "core/devices/DeviceUri.h"
#include "core/seal/Secret.h"
#include "core/study/Gates.h"

namespace tacto::gui {

struct PilotStart {
    QString folder;                            ///< the study's folder
    QString title;                             ///< the study's title, or the name of a rehearsal's folder
    std::shared_ptr<const Secret> passphrase;  ///< null: a rehearsal
    std::string participant = "virtual:1";     ///< a code, or virtual:SEED
    std::vector<DeviceUri> devices{{"sim", "", {}}};
    bool massager = false;      ///< delivers, in place of electrodes
    QString who;                ///< for the operator: "P-7K3D", "virtual, seed 1"
    bool person = false;        ///< someone sits at the participant's window; else a virtual participant answers
    bool confirmsCode = false;  ///< they are asked first whether this code is theirs
    bool rehearsal = true;
    std::vector<ExclusionAnswer> exclusions{};  ///< a person's
    std::string protocol = "pilot-identification";
    std::string method = "quest";    ///< of detection
    std::string unfinished{};        ///< what to do with an interrupted session: "resume" or "end"; empty: none exists
    std::uint64_t seed = 1;          ///< for the plan and the order, and for a rehearsal's virtual participant
    std::string modality = "study";  ///< for a new rehearsal: "electrodes" or "massager"; "study": as the study says
    std::optional<int> blocks{};     ///< blocks of a rehearsal's test; nothing: as many as the study has
    bool realTime = false;           ///< a virtual participant's session lasts as long as a person's
    bool blind = true;
    KeySet keys = KeySet::Figures;
    std::vector<SeatedDevice> inputs{};              ///< game pads and foot switches, each assigned to one person
    std::shared_ptr<const ButtonDevices> buttons{};  ///< opens them; null where there are none

    QString inputsOf{};                      ///< where their assignment is remembered (InputRows.h)
    std::optional<MarkerAddress> markers{};  ///< nothing: none are sent

    [[nodiscard]] bool simulated() const {
        return std::ranges::all_of(devices, [](const DeviceUri& uri) { return uri.scheme == "sim"; });
    }
};

}  // namespace tacto::gui
