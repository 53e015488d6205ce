// PilotStart.h - the settings with which a pilot session begins in the window.
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
#include "core/exchange/lsl/LslStreams.h"
#include "core/seal/Secret.h"
#include "core/study/Gates.h"

namespace tacto::gui {

struct PilotStart {
    QString folder;                            ///< the study's folder
    QString title;                             ///< the study's title, or the name of a rehearsal's folder
    std::shared_ptr<const Secret> passphrase;  ///< null for a rehearsal
    std::string participant = "virtual:1";     ///< a code, or virtual:SEED
    std::vector<DeviceUri> devices{{"sim", "", {}}};
    bool massager = false;      ///< a massager delivers, in place of electrodes
    QString who;                ///< the participant's name for the operator: "P-7K3D", "virtual, seed 1"
    bool person = false;        ///< a person sits at the participant's window; otherwise a virtual participant answers
    bool confirmsCode = false;  ///< the person is first asked to confirm the code
    bool rehearsal = true;
    std::vector<ExclusionAnswer> exclusions{};  ///< a person's answers
    std::string protocol = "pilot-identification";
    std::string method = "quest";    ///< method to find the detection threshold
    std::string unfinished{};        ///< "resume" or "end" an interrupted session; empty: there is none
    std::uint64_t seed = 1;          ///< seed of the plan and the order, and of a rehearsal's virtual participant
    std::string modality = "study";  ///< for a new rehearsal: "electrodes" or "massager"; "study": the study's own
    std::optional<int> blocks{};     ///< blocks of a rehearsal's test; nothing: as many as in the study
    double pace = 0;                 ///< of a rehearsal, as PilotOrder::pace
    int studyBlocks = 5;             ///< blocks of the test where `blocks` says nothing
    QString language{};              ///< of the participant: "de"; empty: English, or the approval's first
    bool realTime = false;           ///< a session with a virtual participant takes as long as with a person
    bool blind = true;
    KeySet keys = KeySet::Figures;
    std::vector<SeatedDevice> inputs{};              ///< game pads and foot switches, each assigned to one person
    std::shared_ptr<const ButtonDevices> buttons{};  ///< opens them; null if there are none

    QString inputsOf{};                      ///< place for which their use is remembered (InputRows.h)
    std::optional<MarkerAddress> markers{};  ///< nothing: no markers are sent
    LslOrder lsl{};                          ///< none by default

    [[nodiscard]] bool simulated() const {
        return std::ranges::all_of(devices, [](const DeviceUri& uri) { return uri.scheme == "sim"; });
    }
};

}  // namespace tacto::gui
