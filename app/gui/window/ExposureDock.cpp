#include "app/gui/window/ExposureDock.h"

#include <QScrollArea>
#include <algorithm>
#include <cmath>

#include "app/gui/theme/ExposureTable.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {

constexpr int kBetweenBars = 8;

double shareOf(const ExposureRow& row) { return row.evaluated ? row.value / row.limit : -1; }

/// The tightest row of each quantity and place that something is held to.
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
    : FoldingDock(tr("Exposure"), "exposure", "exposureDock", parent), controller_(controller), empty_(new QLabel) {
    auto* area = new QScrollArea(this);
    area->setFrameShape(QFrame::NoFrame);
    area->setWidgetResizable(true);
    area->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    area->setMinimumHeight(1);
    area->setAccessibleName(tr("Exposure against limits"));
    auto* body = new QWidget(area);
    body->setToolTip(
        tr("Worst case over the permitted load range, exposure of the last 5 s included. Hatched: not "
           "evaluated, and never a pass."));
    column_ = new QVBoxLayout(body);
    column_->setContentsMargins(0, 0, scaledPx(12), 0);
    column_->setSpacing(kBetweenBars);
    empty_->setText(tr("Nothing is judged yet: limits appear here once the output is armed."));
    empty_->setWordWrap(true);
    setTextSize(*empty_, TextSize::Small);
    setTone(*empty_, Tone::Quiet);
    column_->addWidget(empty_);
    column_->addStretch();
    area->setWidget(body);
    setContent(area);
}

/// Bars stay where they are while the bench is open: only their numbers change.
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
        column_->insertWidget(column_->count() - 1, bars_.back());
    }
    empty_->setVisible(rows.empty());
}

void ExposureDock::refresh(const Telemetry& telemetry) {
    if (telemetry.at == shownAt_ && bars_.empty() == telemetry.exposure().empty()) return;
    shownAt_ = telemetry.at;
    const auto rows = limitsIn(telemetry.exposure());
    build(rows);
    const auto nearest = std::ranges::max_element(rows, {}, shareOf);
    nearest_ = nearest == rows.end() || !nearest->evaluated
                   ? QString()
                   : tr("%1 of %2")
                         .arg(quantityText(nearest->value, qtext(nearest->unit), 3),
                              settingText(nearest->limit, qtext(nearest->unit)));
    for (std::size_t i = 0; i < rows.size(); ++i) bars_[i]->show(rows[i], controller_.limits().sets);
}

}  // namespace tacto::gui

#include "moc_ExposureDock.cpp"
