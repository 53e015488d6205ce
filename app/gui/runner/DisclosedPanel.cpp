#include "app/gui/runner/DisclosedPanel.h"

#include <QScrollBar>
#include <QTableWidget>
#include <algorithm>
#include <cmath>

#include "app/gui/runner/CaptureStrip.h"
#include "app/gui/theme/Building.h"
#include "app/gui/theme/Pages.h"
#include "app/gui/theme/RecordColumns.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"
#include "app/report/NumberText.h"
#include "app/report/TableContent.h"
#include "core/base/JsonText.h"

namespace tacto::gui {

namespace {

constexpr int kGap = 8, kBetween = 16;
constexpr int kMinWave = 140;

/// One row for each output, with the output's value on each load.
struct OutputsByLoad {
    nlohmann::json rows = nlohmann::json::array();
    std::vector<std::string> loads;
};

OutputsByLoad byLoad(const nlohmann::json& disclosed) {
    OutputsByLoad all;
    for (const auto& record : disclosed) {
        const auto load = textOr(record, "load"), output = textOr(record, "output");
        const auto known = std::ranges::find(all.loads, load);
        const auto column = std::to_string(known - all.loads.begin());
        if (known == all.loads.end()) all.loads.push_back(load);
        const auto title = titled(qtext(output)).toStdString();
        auto row = std::ranges::find_if(all.rows, [&](const auto& other) { return other["output"] == title; });
        if (row == all.rows.end()) {
            all.rows.push_back({{"output", title}, {"unit", memberAt(record, "unit")}});
            row = std::prev(all.rows.end());
        }
        (*row)["value" + column] = memberAt(record, "value");
        (*row)["u" + column] = memberAt(record, "expanded_uncertainty");
    }
    return all;
}

QWidget* makePage(QTableWidget& table) {
    auto* page = new QWidget;
    auto* column = columnIn(*page);
    column->addWidget(&table);
    return page;
}

}  // namespace

DisclosedPanel::DisclosedPanel(QWidget* parent)
    : QWidget(parent),
      layout_(new QBoxLayout(QBoxLayout::LeftToRight, this)),
      outputs_(new QWidget(this)),
      table_(new QTableWidget),
      area_(scrollingRows(makePage(*table_), outputs_)),
      none_(new QLabel(tr("No limit set asks for outputs to be disclosed."), outputs_)),
      peak_(makeLabel({}, {.name = "strongestOutput", .size = TextSize::Small, .strong = true, .wraps = true}, this)),
      wave_(new CaptureStrip(this)) {
    layout_->setContentsMargins(0, kGap, 0, 0);
    layout_->setSpacing(kBetween);
    auto* tracing = new QVBoxLayout;
    tracing->setSpacing(0);
    tracing->addWidget(peak_);
    wave_->setMinimumHeight(scaledPx(kMinWave));
    tracing->addWidget(wave_, 1);
    layout_->addLayout(tracing, 1);
    auto* column = columnIn(*outputs_, kGap / 2);
    column->addWidget(makeLabel(tr("Outputs to disclose"), {.size = TextSize::Small, .strong = true}, outputs_));
    none_->setWordWrap(true);
    setTone(*none_, Tone::Quiet);
    column->addWidget(none_);
    area_->setObjectName("disclosedOutputs");
    area_->viewport()->setAutoFillBackground(false);
    area_->widget()->setAutoFillBackground(false);
    setTextSize(*table_, TextSize::Small);
    table_->setSizeAdjustPolicy(QAbstractScrollArea::AdjustToContents);  // the whole table is visible if there is room
    column->addWidget(area_, 1);
    column->addStretch();
    layout_->addWidget(outputs_);
    setTabOrder(wave_, area_);  // as they are read
    setTabOrder(area_, table_);
    showOutputs(Outputs::Beside);
    clear();
}

int DisclosedPanel::leastHeight() const {
    return kGap + QFontMetrics(textFont(TextSize::Small)).height() + wave_->minimumHeight();
}

int DisclosedPanel::wholeHeight() const {
    if (area_->isHidden()) return leastHeight();
    return kGap + kGap / 2 + QFontMetrics(textFont(TextSize::Small)).height() + area_->maximumHeight();
}

void DisclosedPanel::showOutputs(Outputs outputs) {
    narrow_ = outputs == Outputs::BelowNarrow;
    const bool below = narrow_ || outputs == Outputs::Below;
    layout_->setDirection(below ? QBoxLayout::TopToBottom : QBoxLayout::LeftToRight);
    outputs_->setSizePolicy(below ? QSizePolicy::Preferred : QSizePolicy::Maximum,
                            below ? QSizePolicy::Maximum : QSizePolicy::Preferred);
    outputs_->setVisible(outputs != Outputs::Nowhere);
    fitWidth();
}

void DisclosedPanel::fitWidth() {
    const bool whole = !narrow_ && table_->rowCount() > 0;
    area_->setHorizontalScrollBarPolicy(narrow_ ? Qt::ScrollBarAsNeeded : Qt::ScrollBarAlwaysOff);
    area_->setMinimumWidth(whole ? table_->maximumWidth() + area_->verticalScrollBar()->sizeHint().width() : 1);
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
    // An output with a measured current replaces any without: a check judges the current through the load.
    if (!(peak > strongest_) && !(unit == "A" && unit_ == "V")) return;
    if (unit == "V" && unit_ == "A") return;
    strongest_ = peak;
    unit_ = unit;
    peak_->setText(tr("Strongest output captured: %1 at its peak").arg(quantityText(peak, unit, 3)));
    wave_->show(capture);
}

void DisclosedPanel::showTracing(const std::shared_ptr<const Capture>& capture, const QString& title) {
    peak_->setText(title);
    wave_->show(capture, capture ? QString() : title);
}

void DisclosedPanel::show(const nlohmann::json& disclosed) {
    const bool any = disclosed.is_array() && !disclosed.empty();
    if (any) {
        using As = ResultColumn::As;
        const auto all = byLoad(disclosed);
        std::vector<ResultColumn> columns{{"Output", "output", As::Text}};
        for (std::size_t i = 0; i < all.loads.size(); ++i) {
            const auto of = std::to_string(i);
            columns.push_back({tr("at %1").arg(loadText(qtext(all.loads[i]))).toStdString(), "value" + of, As::Number,
                               "@unit", "u" + of});
        }
        fillRecordTable(*table_, columns, all.rows);
        layOutRecordTable(*table_);
        fitWidth();
        area_->setMaximumHeight(table_->maximumHeight());
    }
    area_->setVisible(any);
    none_->setVisible(!any);
}

}  // namespace tacto::gui

#include "moc_DisclosedPanel.cpp"
