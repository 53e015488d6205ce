#include "app/gui/scope/measurements/MeasurementTable.h"

#include <QHeaderView>
#include <QLabel>
#include <QMenu>
#include <QPushButton>
#include <QScrollBar>
#include <QTableWidget>
#include <QTimer>
#include <algorithm>
#include <cmath>

#include "app/gui/scope/screen/LaneLegend.h"
#include "app/gui/theme/Building.h"
#include "app/gui/theme/TableText.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {

constexpr int kPerChannel = static_cast<int>(kStatistics.size());
constexpr int kMinRows = 2;
/// The statistics that are hidden if the table is too narrow, group by group in this order.
const std::vector<std::vector<Statistic>> kGiveWay{
    {Statistic::Count}, {Statistic::Min, Statistic::Max}, {Statistic::Sd}, {Statistic::Mean}};

std::size_t indexOf(Statistic statistic) {
    return static_cast<std::size_t>(std::ranges::find(kStatistics, statistic) - kStatistics.begin());
}

int columnOf(std::size_t channel, std::size_t statistic) {
    return 1 + static_cast<int>(channel) * kPerChannel + static_cast<int>(statistic);
}

}  // namespace

MeasurementTable::MeasurementTable(ChosenReadings& chosen, QWidget* parent)
    : QWidget(parent),
      chosen_(chosen),
      table_(new QTableWidget(this)),
      seen_(new QLabel(this)),
      warnings_(makeLabel({}, {.name = "warnings", .wraps = true, .selectable = true}, this)),
      choose_(new QPushButton(tr("Choose…"), this)),
      reset_(new QPushButton(tr("Reset statistics"), this)) {
    nameWidget(*table_, "measurements", tr("Measurements"));
    makeReadOnly(*table_);
    table_->setShowGrid(false);
    table_->setFrameShape(QFrame::NoFrame);
    table_->horizontalHeader()->setHighlightSections(false);
    for (QWidget* small : {static_cast<QWidget*>(table_), static_cast<QWidget*>(table_->horizontalHeader())})
        setTextSize(*small, TextSize::Small);
    choose_->setToolTip(tr("Chooses the rows, here and in the dock."));
    choose_->setMenu(makeReadingsMenu(chosen_, choose_));
    reset_->setToolTip(tr("Forgets the captures seen so far, and what is averaged; the next one is the first."));
    connect(reset_, &QPushButton::clicked, this, [this] {
        clear();
        emit resetClicked();
    });
    connect(&chosen_, &ChosenReadings::changed, this, [this] {
        lay();
        refill();
    });
    warnings_->hide();
    seen_->setWordWrap(true);
    auto* line = new QHBoxLayout;
    line->addWidget(seen_, 1);
    addAll(*line, {choose_, reset_});
    setTabOrder(reset_, table_);
    auto* layout = columnIn(*this, 4, {8, 4, 8, 0});
    layout->addLayout(line);
    layout->addWidget(table_, 1);
    layout->addWidget(warnings_);
    layout->addStretch();  // fills the space while the table is still hidden
    restyle();
    refill();
    onLookChange(*this, [this] { restyle(); });
    onEvent(*this, QEvent::Resize, [this] {
        QTimer::singleShot(0, this, &MeasurementTable::fitColumns);  // after the table got its width
    });
}

void MeasurementTable::add(const ShownPtr& shown) {
    passedOver_ = false;
    newest_ = shown;
    const auto channels = statistics_.channels().size();
    statistics_.add(*shown);
    if (channels != statistics_.channels().size() || statistics_.captures() == 1) lay();
    QStringList sentences;
    for (const auto& warning : shown->warnings) sentences << sentence(QString::fromStdString(warning));
    warnings_->setText(sentences.join("\n"));
    warnings_->setVisible(!sentences.isEmpty());
    refill();
}

void MeasurementTable::passOverUntriggered(bool held) {
    passedOver_ = true;
    held_ = held;
    statistics_.breakOff();
    warnings_->clear();
    warnings_->hide();
    refill();
}

void MeasurementTable::clear() {
    passedOver_ = false;
    newest_.reset();
    statistics_.clear();
    warnings_->clear();
    warnings_->hide();
    table_->setRowCount(0);
    refill();
}

void MeasurementTable::lay() {
    const auto& channels = statistics_.channels();
    const auto& readings = chosen_.all();
    table_->setColumnCount(1 + static_cast<int>(channels.size()) * kPerChannel);
    QStringList titles{tr("Measurement")};
    for (const auto& channel : channels) {
        titles << titled(channel.name);
        for (std::size_t s = 1; s < kStatistics.size(); ++s) titles << nameOf(kStatistics[s]);
    }
    table_->setHorizontalHeaderLabels(titles);
    for (int c = 0; c < table_->columnCount(); ++c) {
        auto* head = table_->horizontalHeaderItem(c);
        head->setTextAlignment((c == 0 ? Qt::AlignLeft : Qt::AlignRight) | Qt::AlignVCenter);
        if (c == 0) continue;
        const auto& channel = channels[static_cast<std::size_t>((c - 1) / kPerChannel)];
        const auto statistic = kStatistics[static_cast<std::size_t>((c - 1) % kPerChannel)];
        head->setData(kCopiedTextRole, titled(channel.name) + " " + nameOf(statistic));
    }
    table_->setRowCount(static_cast<int>(readings.size()));
    for (int row = 0; row < table_->rowCount(); ++row) {
        const auto name = nameOf(readings[static_cast<std::size_t>(row)]);
        for (int c = 0; c < table_->columnCount(); ++c) {
            auto* item = new QTableWidgetItem(c == 0 ? name.title : QString());
            item->setTextAlignment((c == 0 ? Qt::AlignLeft : Qt::AlignRight) | Qt::AlignVCenter);
            table_->setItem(row, c, item);
        }
        table_->item(row, 0)->setToolTip(name.explained);
    }
    restyle();
}

void MeasurementTable::refill() {
    const auto& channels = statistics_.channels();
    for (int row = 0; row < table_->rowCount(); ++row) {
        const auto reading = chosen_.all()[static_cast<std::size_t>(row)];
        for (std::size_t c = 0; c < channels.size(); ++c) {
            const auto& its = channels[c].of(reading);
            for (std::size_t s = 0; s < kStatistics.size(); ++s) {
                auto* item = table_->item(row, columnOf(c, s));
                item->setText(statisticText(reading, kStatistics[s], its, channels[c].unit));
                const bool last = kStatistics[s] == Statistic::Last, bound = last && its.upperBound();
                item->setToolTip(item->text() != "–" && !bound ? (last ? hiddenText(c, reading) : QString())
                                 : its.n() == 1                ? tr("One reading has no standard deviation.")
                                 : newest_ == nullptr          ? QString()
                                                               : whyMissing(reading, *newest_, c));
            }
        }
    }
    const auto n = static_cast<int>(statistics_.captures());
    auto said = n == 0   ? tr("Measurements appear with the first capture.")
                : n == 1 ? tr("Over 1 capture")
                         : tr("Over %1 captures").arg(n);
    if (const auto since = statistics_.sinceText(); n > 0 && !since.isEmpty()) said += " " + since;
    if (n > 1 && newest_ && newest_->averaged > 0) said += tr(" · of averages: the spread is theirs");
    if (passedOver_) {
        said = n == 0  ? tr("Untriggered: nothing is measured. Measurements appear with the first trigger.")
               : held_ ? said + tr(" · no trigger since: the last train is held on the screen")
                       : said + tr(" · the record shown now is untriggered and not counted");
    }
    seen_->setText(said);
    reset_->setEnabled(n > 0);
    table_->setVisible(n > 0);
}

/// Hides the statistics that do not fit, the same ones for every channel.
void MeasurementTable::fitColumns() {
    const auto hide = [this](const std::vector<Statistic>& group, bool hidden) {
        for (const auto statistic : group)
            for (std::size_t c = 0; c < statistics_.channels().size(); ++c)
                table_->setColumnHidden(columnOf(c, indexOf(statistic)), hidden);
    };
    for (const auto& group : kGiveWay) hide(group, false);
    const auto margins = layout()->contentsMargins();
    // The width without the frame, and without the scroll bar, which shows if not all rows are in sight.
    const int room = width() - margins.left() - margins.right() - 2 -
                     style()->pixelMetric(QStyle::PM_ScrollBarExtent, nullptr, table_->verticalScrollBar());
    for (const auto& group : kGiveWay) {
        if (table_->horizontalHeader()->length() <= room) break;
        hide(group, true);
    }
    // The table can shrink to these columns before the screen shrinks.
    const auto& header = *table_->horizontalHeader();
    table_->setMinimumHeight(std::max(header.height(), header.sizeHint().height()) +
                             kMinRows * table_->verticalHeader()->defaultSectionSize() + 4);
    refill();
}

/// Returns the hidden statistics: "mean 12.99 V · s.d. 520 µV"; empty if all are in sight.
QString MeasurementTable::hiddenText(std::size_t channel, Reading reading) const {
    const auto& its = statistics_.channels()[channel];
    QStringList parts;
    for (std::size_t s = 1; s < kStatistics.size(); ++s)
        if (table_->isColumnHidden(columnOf(channel, s)))
            parts << nameOf(kStatistics[s]) + " " + statisticText(reading, kStatistics[s], its.of(reading), its.unit);
    return parts.join(" · ");
}

QString MeasurementTable::asText() const { return separated(textOf(*table_), '\t'); }

QStringList MeasurementTable::asLines() const {
    QStringList lines;
    for (const auto& channel : statistics_.channels()) {
        QStringList parts;
        for (const auto reading : chosen_.all()) {
            const auto text = statisticText(reading, Statistic::Last, channel.of(reading), channel.unit);
            if (text != "–") parts << nameOf(reading).title + " " + text;
        }
        if (!parts.isEmpty()) lines << channel.letter + ":  " + parts.join(QStringLiteral("   "));
    }
    return lines;
}

void MeasurementTable::restyle() {
    const auto plain = digits(textFont(TextSize::Small)), strong = digits(textFont(TextSize::Small, QFont::DemiBold));
    table_->verticalHeader()->setDefaultSectionSize(QFontMetrics(plain).height() + scaledPx(6));
    // The newest reading is bold and in its channel's colour; the rest is quiet. The columns are wide enough for every
    // value, because numbers that jump cannot be read.
    const auto& channels = statistics_.channels();
    const int number = QFontMetrics(strong).horizontalAdvance("−000.0 mV") + scaledPx(12);
    for (int c = 0; c < table_->columnCount(); ++c) {
        const int statistic = c == 0 ? -1 : (c - 1) % kPerChannel;
        const bool isLast = statistic == 0, isCount = statistic == kPerChannel - 1;
        const auto channel = static_cast<std::size_t>(std::max(0, c - 1) / kPerChannel);
        const auto colour = c == 0    ? colours().text
                            : !isLast ? colours().quiet
                                      : channelInk(channels[channel].letter, channel);
        for (int row = 0; row < table_->rowCount(); ++row) {
            table_->item(row, c)->setFont(isLast ? strong : plain);
            table_->item(row, c)->setForeground(colour);
        }
        if (c > 0) table_->setColumnWidth(c, isCount ? QFontMetrics(plain).horizontalAdvance("000000") : number);
    }
    table_->resizeColumnToContents(0);
    fitColumns();
}

}  // namespace tacto::gui

#include "moc_MeasurementTable.cpp"
