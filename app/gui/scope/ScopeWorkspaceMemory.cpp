// What the oscilloscope remembers from one start to the next, in the group "scope" of the program's settings.
#include <QSplitter>
#include <QToolButton>
#include <array>
#include <cmath>

#include "app/gui/scope/AcquisitionPanel.h"
#include "app/gui/scope/Remembered.h"
#include "app/gui/scope/ScopeView.h"
#include "app/gui/scope/ScopeWorkspace.h"
#include "app/gui/scope/Steps.h"
#include "app/gui/scope/ViewPanel.h"

namespace tacto::gui {

namespace {

constexpr std::array<const char*, 4> kModes{"auto", "normal", "single", "roll"};  // in ScopeMode's order
constexpr int kMaxLanes = 64;
constexpr double kFurthest = 1000;  ///< divisions from the middle that a lane's zero may lie

/// A scale is a step of the ladder; anything else was not written by us.
std::optional<double> rememberedStep(const QSettings& settings, const QString& key, double low, double high) {
    const auto step = rememberedNumber(settings, key, low, high);
    if (!step || std::abs(stepNotBelow(*step * (1 - 1e-9)) - *step) > 1e-6 * *step) return std::nullopt;
    return step;
}

void saveView(QSettings& settings, const ChosenView& chosen) {
    settings.remove("time");
    if (chosen.time) {
        settings.setValue("time/perDivision", chosen.time->perDivision_s);
        settings.setValue("time/left", chosen.time->left_s);
    }
    settings.remove("lanes");
    settings.beginWriteArray("lanes");
    int index = 0;
    for (const auto& [key, scale] : chosen.lanes) {
        settings.setArrayIndex(index++);
        settings.setValue("key", key);
        settings.setValue("perDivision", scale.perDivision);
        settings.setValue("position", scale.position);
    }
    settings.endArray();
}

ChosenView restoredView(QSettings& settings) {
    ChosenView chosen;
    const auto perDivision = rememberedStep(settings, "time/perDivision", 1e-9, 1e4);
    const auto left = rememberedNumber(settings, "time/left", -1e7, 1e7);
    if (perDivision && left) chosen.time = ChosenView::Time{*left, *perDivision};
    const int lanes = std::clamp(settings.beginReadArray("lanes"), 0, kMaxLanes);
    for (int i = 0; i < lanes; ++i) {
        settings.setArrayIndex(i);
        const auto key = settings.value("key").toString();
        const auto scale = rememberedStep(settings, "perDivision", 1e-12, 1e6);
        const auto position = rememberedNumber(settings, "position", -kFurthest, kFurthest);
        if (!key.isEmpty() && scale && position) chosen.lanes[key] = LaneScale{*scale, *position};
    }
    settings.endArray();
    return chosen;
}

}  // namespace

void ScopeWorkspace::save() const {
    QSettings settings;
    settings.beginGroup("scope");
    settings.setValue("mode", kModes[static_cast<std::size_t>(mode_)]);
    acquisition_->save(settings);
    viewPanel_->save(settings);
    saveView(settings, view_->chosenView());
    settings.setValue("panels", plots_->saveState());
    settings.setValue("controls", controlsWanted_);
}

void ScopeWorkspace::restore() {
    QSettings settings;
    settings.beginGroup("scope");
    acquisition_->restore(settings);
    viewPanel_->restore(settings);
    view_->setChosenView(restoredView(settings));
    plots_->restoreState(settings.value("panels").toByteArray());  // says no to what it did not write
    plots_->setOrientation(Qt::Vertical);
    plots_->setChildrenCollapsible(false);
    controlsWanted_ = rememberedFlag(settings, "controls").value_or(true);
    fitControls();
    const auto mode = std::find(kModes.begin(), kModes.end(), settings.value("mode").toString());
    applyMode(mode == kModes.end() ? mode_ : static_cast<ScopeMode>(mode - kModes.begin()));
}

}  // namespace tacto::gui
