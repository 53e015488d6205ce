#include "app/gui/window/OutputDocks.h"

#include <QAbstractButton>
#include <algorithm>
#include <cmath>
#include <functional>

#include "app/gui/live/DrivePanel.h"
#include "app/gui/theme/Building.h"
#include "app/gui/theme/ExposureTable.h"
#include "app/gui/theme/Pages.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"
#include "app/gui/window/StateWords.h"

namespace tacto::gui {

namespace {

constexpr int kBetweenBars = 8;

/// A row takes the first place only if it is nearer to its limit than the first row by this share of the limit.
constexpr double kClearlyNearer = 0.05;

double shareOf(const ExposureRow& row) { return row.evaluated ? row.value / row.limit : -1; }

/// Returns the tightest row of each limited quantity and place.
std::vector<ExposureRow> limitsIn(std::span<const ExposureRow> rows) {
    std::vector<ExposureRow> found;
    for (const auto& row : rows) {
        if (std::isnan(row.limit) || row.action == LimitAction::Disclose) continue;
        const auto same = std::ranges::find_if(found, [&](const ExposureRow& other) {
            return other.quantity == row.quantity && other.judged == row.judged;
        });
        if (same == found.end())
            found.push_back(row);
        else if (shareOf(row) > shareOf(*same))
            *same = row;
    }
    return found;
}

}  // namespace

ExposureDock::ExposureDock(const BenchController& controller, QWidget* parent)
    : FoldingDock(tr("Exposure"), "exposure", "exposureDock", parent),
      controller_(controller),
      empty_(new QLabel),
      now_(new ElidedLabel),
      enterArea_(new QPushButton(tr("Enter the area…"))) {
    auto* body = new QWidget;
    body->setToolTip(
        tr("Worst case over the permitted load range, exposure of the last 5 s included: upper bounds, for a train "
           "counts whole in every window that it may touch. Hatched: not evaluated, and never a pass."));
    column_ = columnIn(*body, kBetweenBars, {0, 0, scaledPx(12), 0});
    empty_->setText(tr("Nothing is judged yet: limits appear here once the output is armed."));
    empty_->setWordWrap(true);
    setTextSize(*empty_, TextSize::Small);
    setTone(*empty_, Tone::Quiet);
    column_->addWidget(empty_);
    now_->setObjectName("exposureNow");
    setTextSize(*now_, TextSize::Small);
    setTone(*now_, Tone::Quiet);
    enterArea_->setObjectName("enterArea");
    enterArea_->setToolTip(
        tr("Current and power density need the electrode’s area: opens the encoding profile there."));
    connect(enterArea_, &QPushButton::clicked, this, &ExposureDock::areaWanted);
    column_->addWidget(now_);  // below the bars, because the nearest limit comes first
    column_->addWidget(enterArea_, 0, Qt::AlignLeft);
    for (QWidget* later : {static_cast<QWidget*>(now_), static_cast<QWidget*>(enterArea_)}) later->hide();
    column_->addStretch();
    auto* rows = scrollingRows(body, this);
    rows->setAccessibleName(tr("Exposure against limits"));
    setContent(rows);
}

/// Bars keep their order and only their numbers change, until another bar is clearly nearer to its limit than the
/// first.
void ExposureDock::putInOrder(std::vector<ExposureRow>& rows) const {
    const auto placeOf = [this](const ExposureRow& row) { return titles_.indexOf(titled(rowTitle(row))); };
    const bool same = qsizetype(rows.size()) == titles_.size() &&
                      std::ranges::all_of(rows, [&](const ExposureRow& row) { return placeOf(row) >= 0; });
    if (!same) return std::ranges::stable_sort(rows, std::greater(), shareOf), void();
    std::ranges::sort(rows, {}, placeOf);
    const auto nearest = std::ranges::max_element(rows, {}, shareOf);
    if (nearest != rows.end() && shareOf(*nearest) > shareOf(rows.front()) + kClearlyNearer)
        std::rotate(rows.begin(), nearest, nearest + 1);
}

void ExposureDock::build(const std::vector<ExposureRow>& rows) {
    QStringList titles;
    for (const auto& row : rows) titles << titled(rowTitle(row));
    if (titles == titles_) return;
    titles_ = titles;
    for (auto* bar : bars_) delete bar;
    bars_.clear();
    for (const auto& row : rows) {
        bars_.push_back(new LimitBar(shortRowTitle(row), widget(), LimitBar::Shape::Line));
        bars_.back()->setAccessibleName(titled(rowTitle(row)));
        column_->insertWidget(column_->count() - 3, bars_.back());
    }
    empty_->setVisible(rows.empty());
    now_->setVisible(!rows.empty());
}

void ExposureDock::refresh(const Telemetry& telemetry) {
    if (telemetry.at == shownAt_ && telemetry.state == shownState_ && bars_.empty() == telemetry.exposure().empty())
        return;
    shownAt_ = telemetry.at;
    shownState_ = telemetry.state;
    const auto all = exposureNow(telemetry);
    auto rows = limitsIn(all);
    putInOrder(rows);
    build(rows);
    const auto now = outputIsOff(telemetry.state) ? tr("Output is off: nothing is delivered.")
                                                  : tr("Worst case, with the last 5 s.");
    if (now_->text() != now) now_->setText(now);
    enterArea_->setVisible(!controller_.profile().electrodeArea &&
                           std::ranges::any_of(rows, [](const ExposureRow& row) { return !row.evaluated; }));
    const auto nearest = std::ranges::max_element(rows, {}, shareOf);
    nearest_ = nearest == rows.end() || !nearest->evaluated ? QString() : valueOfLimitText(*nearest);
    for (std::size_t i = 0; i < rows.size(); ++i) bars_[i]->show(rows[i], controller_.limits().sets);
}

DriveDock::DriveDock(BenchController& controller, QWidget* parent)
    : FoldingDock(tr("Drive"), "drive", "driveDock", parent), panel_(new DrivePanel(controller, this)) {
    setContent(panel_, Room::First);
    connect(&controller, &BenchController::changed, panel_, &DrivePanel::begin);
}

void DriveDock::refresh(const Telemetry& telemetry) { panel_->refresh(telemetry); }

void DriveDock::takeFocus() {
    for (auto* button : panel_->findChildren<QAbstractButton*>()) {
        if (button->isChecked() && button->isVisible()) return button->setFocus(Qt::ShortcutFocusReason);
    }
}

QString DriveDock::keyFigure() const { return panel_->headline(); }

}  // namespace tacto::gui

#include "moc_OutputDocks.cpp"
