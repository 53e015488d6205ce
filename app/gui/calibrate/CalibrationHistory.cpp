#include "app/gui/calibrate/CalibrationHistory.h"

#include <QHeaderView>
#include <cmath>
#include <set>

#include "app/gui/calibrate/CalibrationTrendView.h"
#include "app/gui/theme/Building.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {

enum Column { kState, kMade, kUntil, kGain, kOffset, kUncertainty, kRange, kInstruments, kColumns };

QString instrumentsOf(const StoredCalibration& c) {
    QStringList all;
    for (const auto& one : c.instruments) {
        const auto due =
            one.due ? QObject::tr("due %1").arg(qtext(dateText(*one.due))) : QObject::tr("due date not stated");
        all << QString("%1 %2, %3").arg(QString::fromStdString(one.name), QString::fromStdString(one.serial), due);
    }
    return all.isEmpty() ? QString("–") : all.join("; ");
}

/// Returns the fitted lines of the times, as in the trend: "Interval × 1.0000 + 1.0 µs, ± 0.0060 %".
QString timesText(const StoredCalibration& c) {
    QStringList all;
    for (const auto& time : kStoredTimes) {
        const auto& line = c.*time.line;
        if (!line) continue;
        all << QString("%1 × %2 %3 %4, ± %5")
                   .arg(qtext(time.title), decimalText(line->gain, 4), line->offset < 0 ? "−" : "+",
                        quantityText(std::abs(line->offset), "s", 2), quantityText(line->uncertainty_pct, "%", 2));
    }
    return all.join("\n");
}

}  // namespace

CalibrationHistory::CalibrationHistory(QWidget* parent) : QWidget(parent) {
    auto* column = new QVBoxLayout(this);
    empty_ = makeLabel({}, {.name = "historyEmpty", .tone = Tone::Quiet, .wraps = true}, this);
    column->addWidget(empty_);
    trend_ = new CalibrationTrendView(this);
    column->addWidget(trend_, 3);
    table_ = new QTableWidget(0, kColumns, this);
    nameWidget(*table_, "calibrationHistory", tr("Stored calibrations"),
               tr("Every calibration of this stimulator. A newer one supersedes the older, which stays; what is "
                  "stored cannot be changed without being noticed."));
    table_->setHorizontalHeaderLabels({tr("State"), tr("Made"), tr("Valid until"), tr("Gain"), tr("Offset"),
                                       tr("U (95 %)"), tr("Range"), tr("Measured with")});
    makeReadOnly(*table_);
    table_->setSelectionBehavior(QAbstractItemView::SelectRows);
    table_->setAlternatingRowColors(true);
    table_->setWordWrap(false);
    table_->horizontalHeader()->setStretchLastSection(true);  // elided; the tool tip shows the full text
    table_->horizontalHeader()->setDefaultAlignment(Qt::AlignLeft | Qt::AlignVCenter);
    table_->setHorizontalScrollMode(QAbstractItemView::ScrollPerPixel);
    column->addWidget(table_, 2);
    afterLookChange(*this, [this] { fitColumns(); });
}

void CalibrationHistory::list(const CalibrationBook& book, const std::optional<StimulatorId>& stimulator) {
    const auto all = stimulator ? book.history(stimulator->serial) : std::vector<StoredCalibration>();
    empty_->setText(!stimulator
                        ? tr("Here each stimulator has its calibrations over time.")
                        : tr("Stimulator %1 was never calibrated. Calibrate measures what it delivers and keeps "
                             "the result here, with the instruments it rests on and the day until which it "
                             "holds.")
                              .arg(QString::fromStdString(stimulator->serial)));
    empty_->setVisible(all.empty());
    table_->setVisible(!all.empty());
    trend_->setVisible(!all.empty());
    trend_->show({all.rbegin(), all.rend()});
    table_->setRowCount(int(all.size()));
    std::set<std::string> newer;  // units for which a newer calibration was listed
    for (int row = 0; row < int(all.size()); ++row) {
        const auto& c = all[std::size_t(row)];
        const auto unit = QString::fromStdString(c.unit);
        const bool newest = newer.insert(c.unit).second;
        auto asIt = *stimulator;
        asIt.unit = c.unit;
        const bool counts = newest && book.standing(asIt).state == CalibrationState::Valid;
        auto state = !newest ? tr("– superseded") : counts ? tr("✔ counts") : tr("⚠ does not count");
        if (newest && c.validUntil < utcToday()) state = tr("⚠ expired");
        if (c.simulated) state += tr(", simulated");
        const QString cells[kColumns] = {
            state,
            qtext(dateText(c.made)),
            qtext(dateText(c.validUntil)),
            decimalText(c.amplitude.gain, 4),
            quantityText(c.amplitude.offset, unit, 2),
            quantityText(c.amplitude.uncertainty_pct, "%", 2),
            tr("%1 to %2").arg(settingText(c.amplitude.lowest, unit), settingText(c.amplitude.highest, unit)),
            instrumentsOf(c)};
        for (int column = 0; column < kColumns; ++column) {
            auto* item = new QTableWidgetItem(cells[column]);
            const bool right = column >= kGain && column <= kUncertainty;
            item->setTextAlignment((right ? Qt::AlignRight : Qt::AlignLeft) | Qt::AlignVCenter);
            item->setToolTip(column == kInstruments ? cells[column] : timesText(c));
            table_->setItem(row, column, item);
        }
    }
    fitColumns();
}

void CalibrationHistory::fitColumns() {
    setTextSize(*table_, TextSize::Small);  // makes eight columns fit a small window
    setTextSize(*table_->horizontalHeader(), TextSize::Small);
    for (int column = 0; column < kInstruments; ++column) table_->resizeColumnToContents(column);
}

}  // namespace tacto::gui

#include "moc_CalibrationHistory.cpp"
