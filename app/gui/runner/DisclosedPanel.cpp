#include "app/gui/runner/DisclosedPanel.h"

#include <QScrollArea>
#include <QTableWidget>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "app/gui/runner/CaptureStrip.h"
#include "app/gui/runner/LoadCaptures.h"
#include "app/gui/theme/RecordColumns.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"
#include "app/report/NumberText.h"

namespace tacto::gui {

namespace {

constexpr int kGap = 8;
constexpr int kMinWave = 150;

/// "maximum power density" above "(over 1 s)".
std::string onTwoLines(std::string name) {
    if (const auto at = name.find(" ("); at != std::string::npos) name[at] = '\n';
    return name;
}

}  // namespace

DisclosedPanel::DisclosedPanel(QWidget* parent)
    : QWidget(parent),
      area_(new QScrollArea(this)),
      none_(new QLabel(tr("No limit set asks for outputs to be disclosed."), this)),
      peak_(new QLabel(this)),
      wave_(new CaptureStrip(this)) {
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(kGap, 0, 0, 0);
    column->setSpacing(kGap);
    auto* heading = new QLabel(tr("Outputs to disclose"), this);
    setTextSize(*heading, TextSize::Body, true);
    column->addWidget(heading);
    none_->setWordWrap(true);
    setTone(*none_, Tone::Quiet);
    column->addWidget(none_);
    area_->setObjectName("disclosedOutputs");
    area_->setFrameShape(QFrame::NoFrame);
    area_->setWidgetResizable(true);
    column->addWidget(area_, 3);
    peak_->setObjectName("strongestOutput");
    setTextSize(*peak_, TextSize::Body, true);
    column->addWidget(peak_);
    wave_->setMinimumHeight(scaledPx(kMinWave));
    column->addWidget(wave_, 2);
    clear();
}

void DisclosedPanel::clear() {
    strongest_ = -1;
    unit_.clear();
    wave_->show(nullptr);
    peak_->setText(tr("Nothing was captured"));
    show(nlohmann::json());
}

void DisclosedPanel::take(const std::shared_ptr<const Capture>& capture) {
    if (!capture || capture->untriggered) return;
    const double amps = peakIn(*capture, "A");
    const QString unit = amps >= 0 ? "A" : "V";
    const double peak = amps >= 0 ? amps : peakIn(*capture, "V");
    // One with a current counts more than all without: what a load lets through is what is judged.
    if (!(peak > strongest_) && !(unit == "A" && unit_ == "V")) return;
    if (unit == "V" && unit_ == "A") return;
    strongest_ = peak;
    unit_ = unit;
    peak_->setText(tr("Strongest output captured: %1 at its peak").arg(quantityText(peak, unit, 3)));
    wave_->show(capture);
}

void DisclosedPanel::showTracing(const std::shared_ptr<const Capture>& capture, const QString& title) {
    peak_->setText(title);
    wave_->show(capture);
}

void DisclosedPanel::show(const nlohmann::json& disclosed) {
    const bool any = disclosed.is_array() && !disclosed.empty();
    delete area_->takeWidget();
    if (any) {
        using As = RecordColumn::As;
        auto records = disclosed;
        for (auto& record : records) {
            // What stands in parentheses goes below the name: together they are wider than the column.
            if (const auto& name = memberAt(record, "output"); name.is_string())
                record["output"] = onTwoLines(name.get<std::string>());
        }
        area_->setWidget(makeRecordTable({{tr("Load"), "load", As::Load},
                                          {tr("Value"), "value", As::Number, "@unit", "expanded_uncertainty"},
                                          {tr("Output"), "output", As::Text}},
                                         records, area_));
    }
    area_->setVisible(any);
    none_->setVisible(!any);
}

}  // namespace tacto::gui

#include "moc_DisclosedPanel.cpp"
