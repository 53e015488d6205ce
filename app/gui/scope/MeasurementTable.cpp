#include "app/gui/scope/MeasurementTable.h"

#include <QClipboard>
#include <QGuiApplication>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QKeyEvent>
#include <QLabel>
#include <QPushButton>
#include <QTableWidget>
#include <QVBoxLayout>
#include <cmath>

#include "app/gui/look/Look.h"
#include "app/gui/look/Text.h"

namespace tacto::gui {

namespace {

enum Statistic { kLast, kMean, kSd, kMin, kMax, kCount, kStatistics };

QString statisticName(int statistic) {
    switch (statistic) {
        case kLast:
            return QObject::tr("last");
        case kMean:
            return QObject::tr("mean");
        case kSd:
            return QObject::tr("s.d.");
        case kMin:
            return QObject::tr("min");
        case kMax:
            return QObject::tr("max");
        default:
            return QObject::tr("n");
    }
}

double statisticOf(const RunningStatistics& s, int statistic) {
    switch (statistic) {
        case kLast:
            return s.last();
        case kMean:
            return s.mean();
        case kSd:
            return s.sd();
        case kMin:
            return s.min();
        case kMax:
            return s.max();
        default:
            return static_cast<double>(s.n());
    }
}

/// A share to a thousandth of a per cent: what is below that is noise.
QString percentText(double value) {
    if (!std::isfinite(value)) return "–";
    const double size = std::abs(value);
    const int decimals = size >= 10 ? 1 : size >= 1 ? 2 : 3;
    return QString::number(value, 'f', decimals).replace('-', QChar(0x2212)) + QChar(0x202f) + "%";
}

QString readingText(Reading reading, double value, const QString& channelUnit) {
    const auto unit = unitOf(reading, channelUnit);
    const double shown = shownFactor(reading, channelUnit) * value;
    return unit == "%" ? percentText(shown) : quantityText(shown, unit);
}

}  // namespace

MeasurementTable::MeasurementTable(QWidget* parent)
    : QWidget(parent),
      table_(new QTableWidget(this)),
      seen_(new QLabel(this)),
      warnings_(new QLabel(this)),
      reset_(new QPushButton(tr("Reset statistics"), this)) {
    table_->setObjectName("measurements");
    table_->setAccessibleName(tr("Measurements"));
    table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
    table_->setSelectionMode(QAbstractItemView::ContiguousSelection);
    table_->setShowGrid(false);
    table_->setTabKeyNavigation(false);
    table_->setFrameShape(QFrame::NoFrame);
    table_->verticalHeader()->hide();
    table_->horizontalHeader()->setHighlightSections(false);
    table_->setColumnCount(2 + static_cast<int>(kReadings));
    QStringList titles{tr("Channel"), QString()};
    for (std::size_t r = 0; r < kReadings; ++r) titles << readingName(static_cast<Reading>(r)).title;
    table_->setHorizontalHeaderLabels(titles);
    for (std::size_t r = 0; r < kReadings; ++r) {
        auto* header = table_->horizontalHeaderItem(2 + static_cast<int>(r));
        header->setToolTip(readingName(static_cast<Reading>(r)).explained);
        header->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
    }
    table_->horizontalHeaderItem(0)->setTextAlignment(Qt::AlignLeft | Qt::AlignVCenter);
    sizeColumns();
    reset_->setToolTip(tr("Forgets the captures seen so far; the next one is the first."));
    connect(reset_, &QPushButton::clicked, this, &MeasurementTable::clear);
    warnings_->setWordWrap(true);
    warnings_->setTextInteractionFlags(Qt::TextSelectableByMouse);
    warnings_->setObjectName("warnings");
    warnings_->hide();
    auto* line = new QHBoxLayout;
    line->addWidget(seen_, 1);
    line->addWidget(reset_);
    seen_->setWordWrap(true);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(4);
    layout->addLayout(line);
    layout->addWidget(table_, 1);
    layout->addWidget(warnings_);
    layout->addStretch();  // takes the room of a table that is not there yet
    refill();
}

/// Wide enough for what may come: columns that jump with every capture cannot be read.
void MeasurementTable::sizeColumns() {
    table_->setFont(digits(font()));
    table_->verticalHeader()->setDefaultSectionSize(fontMetrics().height() + 4);
    auto bold = digits(font());
    bold.setBold(true);
    const QFontMetrics wide(bold);
    for (std::size_t r = 0; r < kReadings; ++r) {
        const int c = 2 + static_cast<int>(r);
        const auto widest = static_cast<Reading>(r) == Reading::Charge ? "00000 µV·s" : "−000.0 mm";
        const auto title = table_->horizontalHeaderItem(c)->text();
        table_->setColumnWidth(c, std::max(wide.horizontalAdvance(widest), fontMetrics().horizontalAdvance(title)) +
                                      fontMetrics().averageCharWidth() * 2);
    }
    setMinimumHeight(fontMetrics().height() * 3);  // it may be squeezed: the screen goes first
}

void MeasurementTable::add(const std::vector<ChannelMeasurement>& measured, const std::vector<std::string>& warnings) {
    passedOver_ = false;
    const auto rows = statistics_.channels().size();
    statistics_.add(measured);
    if (rows != statistics_.channels().size() || statistics_.captures() == 1) layRows();
    QStringList sentences;
    for (const auto& warning : warnings) sentences << titled(QString::fromStdString(warning)) + ".";
    warnings_->setText(sentences.join("\n"));
    warnings_->setVisible(!sentences.isEmpty());
    refill();
}

void MeasurementTable::passOverUntriggered() {
    passedOver_ = true;
    warnings_->clear();
    warnings_->hide();
    refill();
}

void MeasurementTable::clear() {
    passedOver_ = false;
    statistics_.clear();
    warnings_->clear();
    warnings_->hide();
    table_->setRowCount(0);
    refill();
}

void MeasurementTable::layRows() {
    const auto& channels = statistics_.channels();
    table_->setRowCount(static_cast<int>(channels.size()) * kStatistics);
    for (int row = 0; row < table_->rowCount(); ++row) {
        for (int c = 0; c < table_->columnCount(); ++c) {
            auto* item = new QTableWidgetItem;
            item->setTextAlignment((c < 2 ? Qt::AlignLeft : Qt::AlignRight) | Qt::AlignVCenter);
            table_->setItem(row, c, item);
        }
        const auto& channel = channels[static_cast<std::size_t>(row / kStatistics)];
        if (row % kStatistics == 0) table_->item(row, 0)->setText(titled(channel.name));
        table_->item(row, 1)->setText(statisticName(row % kStatistics));
    }
    restyle();
}

void MeasurementTable::fillRow(int row, const CaptureStatistics::Channel& channel, int statistic) {
    for (std::size_t r = 0; r < kReadings; ++r) {
        const auto reading = static_cast<Reading>(r);
        const auto& its = channel.readings[r];
        const double value = statisticOf(its, statistic);
        const bool count =
            statistic == kCount || (reading == Reading::Pulses && statistic != kMean && statistic != kSd);
        auto* item = table_->item(row, 2 + static_cast<int>(r));
        item->setText(count ? (std::isnan(value) ? "–" : QString::number(value, 'f', 0))
                            : readingText(reading, value, channel.unit));
        item->setToolTip(std::isnan(value)
                             ? (its.n() == 1
                                    ? tr("One reading has no standard deviation.")
                                    : tr("Nothing of this kind was measured. %1").arg(readingName(reading).explained))
                             : QString());
    }
}

void MeasurementTable::refill() {
    const auto& channels = statistics_.channels();
    for (std::size_t c = 0; c < channels.size(); ++c) {
        for (int s = 0; s < kStatistics; ++s) fillRow(static_cast<int>(c) * kStatistics + s, channels[c], s);
    }
    const auto n = static_cast<int>(statistics_.captures());
    auto said = n == 0   ? tr("Measurements appear with the first capture.")
                : n == 1 ? tr("Over 1 capture")
                         : tr("Over %1 captures").arg(n);
    if (passedOver_) {
        said = n == 0 ? tr("Untriggered: nothing is measured. Measurements appear with the first trigger.")
                      : said + tr(" · what is shown now is untriggered and not counted");
    }
    seen_->setText(said);
    reset_->setEnabled(n > 0);
    table_->setVisible(n > 0);
}

QString MeasurementTable::asText() const {
    QStringList lines;
    QStringList head;
    for (int c = 0; c < table_->columnCount(); ++c) head << table_->horizontalHeaderItem(c)->text();
    lines << head.join('\t');
    for (int row = 0; row < table_->rowCount(); ++row) {
        QStringList cells;
        for (int c = 0; c < table_->columnCount(); ++c) cells << table_->item(row, c)->text();
        cells[0] = table_->item(row - row % kStatistics, 0)->text();
        lines << cells.join('\t');
    }
    return lines.join('\n');
}

void MeasurementTable::keyPressEvent(QKeyEvent* event) {
    if (event->matches(QKeySequence::Copy)) {
        QGuiApplication::clipboard()->setText(asText());
        return;
    }
    QWidget::keyPressEvent(event);
}

void MeasurementTable::changeEvent(QEvent* event) {
    QWidget::changeEvent(event);
    if (event->type() == QEvent::PaletteChange) restyle();
    if (event->type() != QEvent::FontChange) return;
    sizeColumns();
    restyle();
}

void MeasurementTable::restyle() {
    // The newest reading stands out by weight, its channel by colour; the rest is quiet.
    for (int row = 0; row < table_->rowCount(); ++row) {
        const auto& channel = statistics_.channels()[static_cast<std::size_t>(row / kStatistics)];
        for (int c = 0; c < table_->columnCount(); ++c) {
            auto* item = table_->item(row, c);
            const bool last = row % kStatistics == kLast;
            auto numbers = digits(font());
            numbers.setBold(last);
            item->setFont(numbers);
            item->setForeground(c == 0   ? (channel.unit == "A" ? colours().current : colours().voltage)
                                : c == 1 ? colours().quiet
                                         : colours().text);
        }
    }
    for (const int column : {0, 1}) table_->resizeColumnToContents(column);
}

}  // namespace tacto::gui
