#include "app/gui/scope/measurements/MeasurementSummary.h"

#include <QGridLayout>
#include <QLabel>
#include <QMenu>
#include <QPushButton>
#include <QToolButton>
#include <algorithm>
#include <cmath>

#include "app/gui/scope/screen/LaneLegend.h"
#include "app/gui/theme/Building.h"
#include "app/gui/theme/TabbedPage.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {

constexpr std::size_t kBesideTheName = 2;  ///< most channels at the side of the name; more stand below
constexpr std::size_t kMaxInLine = 3;      ///< most readings in one line; more are set in lines of two
constexpr int kRowHeight = 24;
constexpr int kEdge = 1;  ///< width of the frame around the name buttons

/// Aligned with the other lines of the column; a plain tool button would add a blank on each side.
class NameButton final : public QToolButton {
public:
    using QToolButton::QToolButton;
    [[nodiscard]] QSize sizeHint() const override {
        return {fontMetrics().horizontalAdvance(text()) + 2 * kEdge, QToolButton::sizeHint().height()};
    }
    [[nodiscard]] QSize minimumSizeHint() const override { return sizeHint(); }
};

/// Returns the value at the end of the leading phase: the plateau is the mean around 60 % of the width, and the droop
/// is the slope over the whole width.
double endOfPhase(const ChannelMeasurement& channel) {
    const double droop = std::isfinite(channel.droop.mean) ? channel.droop.mean : 0;
    return channel.amplitude.mean * (1 - 0.4 * droop);
}

const ChannelMeasurement* measuredIn(const std::vector<ChannelMeasurement>& measured, std::string_view unit) {
    for (const auto& channel : measured) {
        if (channel.unit == unit && channel.measuredPulses > 0) return &channel;
    }
    return nullptr;
}

QString inColour(const QString& letter, std::size_t channel) {
    return QString("<span style=\"color:%1\">%2</span>")
        .arg(channelInk(letter, channel).name(), letter.toHtmlEscaped());
}

}  // namespace

double impedanceOf(const std::vector<ChannelMeasurement>& measured) {
    const auto* volts = measuredIn(measured, "V");
    const auto* amps = measuredIn(measured, "A");
    if (volts == nullptr || amps == nullptr || !(endOfPhase(*amps) > 0)) return kNotMeasured;
    return endOfPhase(*volts) / endOfPhase(*amps);
}

MeasurementSummary::MeasurementSummary(QWidget* parent)
    : QWidget(parent),
      head_(makeLabel({}, {.name = "summaryHead", .wraps = true}, this)),
      column_(new QVBoxLayout(this)),
      impedanceName_(new QLabel(tr("|Z|"), this)),
      impedance_(new QLabel(this)),
      note_(makeLabel({}, {.name = "summaryNote", .wraps = true}, this)),
      choose_(new QPushButton(tr("Choose…"), this)),
      reset_(new QPushButton(tr("Reset"), this)) {
    setAccessibleName(tr("Measurements"));
    for (auto* label : {head_, note_, impedanceName_, impedance_}) setTextSize(*label, TextSize::Small);
    impedanceName_->setIndent(kEdge);
    impedanceName_->setToolTip(
        tr("Impedance of the load: voltage over current at the end of the leading phase, at this pulse's width."));
    impedance_->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
    impedance_->setAccessibleName(tr("Impedance"));
    choose_->setToolTip(tr("Chooses what is shown, here and below the oscilloscope's screen."));
    choose_->setMenu(makeReadingsMenu(*chosen_, choose_));
    reset_->setToolTip(tr("Forgets the captures counted here; the next one is the first."));
    connect(reset_, &QPushButton::clicked, this, [this] {
        statistics_.clear();
        if (shown_) statistics_.add(*shown_);
        lay();
    });
    column_->setContentsMargins(0, 0, 0, 0);
    column_->setSpacing(scaledPx(4));
    column_->addWidget(head_);
    auto* load = new QHBoxLayout;
    load->addWidget(impedanceName_);
    load->addWidget(impedance_, 1);
    column_->addLayout(load);
    column_->addWidget(note_);
    auto* buttons = new QHBoxLayout;
    buttons->setSpacing(scaledPx(4));
    addAll(*buttons, {choose_, reset_});
    buttons->addStretch();
    column_->addLayout(buttons);
    column_->addStretch();
    connect(&own_, &ChosenReadings::changed, this, &MeasurementSummary::lay);
    connect(&pipe_, &CapturePipe::prepared, this, &MeasurementSummary::take);
    restyle();
    fill();
    afterLookChange(*this, [this] { lay(); });
}

void MeasurementSummary::follow(ChosenReadings& chosen) {
    chosen_ = &chosen;
    delete choose_->menu();
    choose_->setMenu(makeReadingsMenu(chosen, choose_));
    connect(&chosen, &ChosenReadings::changed, this, &MeasurementSummary::lay);
    lay();
}

void MeasurementSummary::take(const ShownPtr& shown) {
    if (!shown) return;
    if (shown->capture->untriggered) {
        quietSince_ = true;
        statistics_.breakOff();
        return sayHead();
    }
    const bool sameSource = shown_ && shown_->source == shown->source;
    if (!sameSource || !shown->source.isEmpty()) statistics_.clear();
    quietSince_ = false;
    shown_ = shown;
    since_.start();
    statistics_.add(*shown);
    channelsNow() != laid_ ? lay() : fill();
}

QStringList MeasurementSummary::channelsNow() const {
    QStringList all;
    for (const auto& channel : statistics_.channels()) all << channel.letter + ' ' + channel.name;
    return all;
}

void MeasurementSummary::measure(std::shared_ptr<const Capture> capture) {
    pipe_.take(std::move(capture), tr("the run's latest train, not the one on the oscilloscope"));
}

void MeasurementSummary::clear() {
    shown_.reset();
    statistics_.clear();
    quietSince_ = false;
    lay();
}

void MeasurementSummary::refresh(const Telemetry& telemetry) {
    checked_ohm_ = telemetry.impedance_ohm;
    checkAge_s_ = telemetry.impedanceAge_s;
    sayHead();
    sayImpedance();
}

void MeasurementSummary::lay() {
    delete rows_;
    figures_.clear();
    quiet_.clear();
    laid_ = channelsNow();
    rows_ = new QWidget(this);
    grid_ = layoutIn<QGridLayout>(*rows_, -1, {});
    grid_->setHorizontalSpacing(scaledPx(8));
    grid_->setVerticalSpacing(0);
    grid_->setColumnStretch(0, 1);
    column_->insertWidget(1, rows_);
    const auto& channels = statistics_.channels();
    const int first = below() ? 0 : 1;
    for (std::size_t c = 0; c < channels.size(); ++c) {
        auto* title = new QLabel(inColour(channels[c].letter, c), rows_);
        title->setToolTip(titled(channels[c].name));
        title->setAlignment(Qt::AlignRight);
        setTextSize(*title, TextSize::Small, true);
        const auto [line, column] = placeOf(c);
        grid_->addWidget(title, line, first + column);
        if (first == 0) grid_->setColumnStretch(column, 1);
    }
    if (!channels.empty()) {
        for (const auto reading : chosen_->all()) layRow(reading);
    }
    rows_->setVisible(!channels.empty());
    tabAfter(*note_, *rows_);  // in the tab order the rows come before the buttons
    restyle();
    fill();
}

void MeasurementSummary::layRow(Reading reading) {
    const auto name = nameOf(reading);
    auto* button = new NameButton(rows_);
    button->setText(name.title);
    button->setToolTip(tr("%1 A click unfolds its statistics.").arg(name.explained));
    button->setAutoRaise(true);
    button->setCheckable(true);
    button->setChecked(unfolded_ == reading);
    setTextSize(*button, TextSize::Small, unfolded_ == reading);
    button->setProperty("role", "row");
    button->setFixedHeight(std::max(scaledPx(kRowHeight), button->minimumSizeHint().height()));
    connect(button, &QToolButton::clicked, this, [this, reading] { unfold(reading); });
    int row = grid_->rowCount();
    grid_->addWidget(button, row, 0, 1, below() ? inLine() : 1, Qt::AlignLeft);
    layFigures(reading, Statistic::Last, below() ? row + 1 : row, below() ? 0 : 1);
    if (unfolded_ != reading) return;
    for (std::size_t s = 1; s < kStatistics.size(); ++s) {
        row = grid_->rowCount();
        auto* title = makeLabel("    " + nameOf(kStatistics[s]), {.size = TextSize::Small}, rows_);
        quiet_.push_back(title);
        grid_->addWidget(title, row, 0, 1, below() ? inLine() : 1);
        layFigures(reading, kStatistics[s], below() ? row + 1 : row, below() ? 0 : 1);
    }
}

bool MeasurementSummary::below() const { return statistics_.channels().size() > kBesideTheName; }

int MeasurementSummary::inLine() const {
    const auto channels = statistics_.channels().size();
    return static_cast<int>(channels > kMaxInLine ? kBesideTheName : channels);
}

std::pair<int, int> MeasurementSummary::placeOf(std::size_t channel) const {
    return {static_cast<int>(channel) / inLine(), static_cast<int>(channel) % inLine()};
}

void MeasurementSummary::layFigures(Reading reading, Statistic statistic, int row, int column) {
    const auto& channels = statistics_.channels();
    for (std::size_t c = 0; c < channels.size(); ++c) {
        auto* label = new QLabel(rows_);
        label->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
        const auto name = tr("%1 of %2").arg(nameOf(reading).title, titled(channels[c].name));
        label->setAccessibleName(statistic == Statistic::Last ? name : tr("%1, %2").arg(name, nameOf(statistic)));
        setTextSize(*label, TextSize::Small);
        if (statistic != Statistic::Last) quiet_.push_back(label);
        const auto [line, at] = placeOf(c);
        grid_->addWidget(label, row + line, column + at);
        figures_.push_back({reading, statistic, c, label});
    }
}

void MeasurementSummary::unfold(Reading reading) {
    unfolded_ = unfolded_ == reading ? std::nullopt : std::optional(reading);
    // Deferred, because laying out anew deletes the button that is sending this signal.
    QMetaObject::invokeMethod(this, &MeasurementSummary::lay, Qt::QueuedConnection);
}

void MeasurementSummary::fill() {
    QStringList why;
    for (const auto& figure : figures_) {
        const auto& channel = statistics_.channels()[figure.channel];
        const auto& its = channel.of(figure.reading);
        const auto text = statisticText(figure.reading, figure.statistic, its, channel.unit);
        figure.label->setText(text);
        const bool bound = figure.statistic == Statistic::Last && its.upperBound();
        const bool missing = (text == "–" || bound) && shown_;
        const auto reason = missing ? whyMissing(figure.reading, *shown_, figure.channel) : QString();
        const bool single = figure.statistic == Statistic::Sd && its.n() == 1;
        figure.label->setToolTip(!missing ? nameOf(figure.reading).explained
                                 : single ? tr("One reading has no standard deviation.")
                                          : reason);
        if (missing && !bound && figure.reading == Reading::Amplitude && figure.statistic == Statistic::Last) {
            why << tr("%1: %2").arg(titled(channel.name), reason);
        }
    }
    note_->setText(why.join('\n'));
    note_->setVisible(!why.isEmpty());
    for (QWidget* widget : std::initializer_list<QWidget*>{impedanceName_, impedance_, choose_, reset_}) {
        widget->setVisible(shown_ != nullptr);
    }
    sayHead();
    sayImpedance();
}

void MeasurementSummary::sayHead() {
    if (!shown_) {
        head_->setText(quietSince_ ? tr("No trigger yet: nothing is measured.")
                                   : tr("Nothing is measured yet. The figures of the oscilloscope's latest capture "
                                        "appear here."));
        return;
    }
    QStringList parts;
    parts << (shown_->source.isEmpty() ? ageText(static_cast<double>(since_.elapsed()) / 1000) : shown_->source);
    if (statistics_.captures() > 1)
        parts << (tr("last of %1").arg(statistics_.captures()) + " " + statistics_.sinceText()).trimmed();
    if (quietSince_) parts << tr("no trigger since");
    if (shown_->averaged > 0) parts << tr("averaged %1").arg(shown_->averaged);
    if (shown_->capture->simulated) parts << tr("simulated");
    head_->setText(parts.join(QStringLiteral(" · ")));
}

void MeasurementSummary::sayImpedance() {
    if (!shown_) return;
    const double seen = impedanceOf(shown_->measurement);
    const bool checked = !std::isfinite(seen) && std::isfinite(checked_ohm_);
    impedanceName_->setText(checked ? tr("|Z|, check %1").arg(ageText(checkAge_s_)) : tr("|Z|"));
    impedance_->setText(quantityText(checked ? checked_ohm_ : seen, "ohm", 3));
    impedance_->setToolTip(checked ? tr("From the stimulator's last impedance check: the capture does not give it.")
                           : std::isfinite(seen)
                               ? impedanceName_->toolTip()
                               : tr("This needs a measured pulse on a voltage channel and on a current channel."));
}

void MeasurementSummary::restyle() {
    // The numbers stand out and the text around them is quiet. Roles and rich text follow a change of theme; a palette
    // set on a label would be lost when the theme's style sheet is applied.
    for (auto* label : {head_, note_, impedanceName_}) setTone(*label, Tone::Quiet);
    for (auto* label : quiet_) setTone(*label, Tone::Quiet);
    const auto numbers = digits(textFont(TextSize::Small));
    impedanceName_->setMinimumHeight(scaledPx(kRowHeight));
    // Wide enough for every value, because numbers that jump cannot be read. Three or more channels share the room.
    const int wide = QFontMetrics(numbers).horizontalAdvance(QString("00.00\u202fmA"));
    for (const auto& figure : figures_) figure.label->setMinimumWidth(below() ? 0 : wide);
}

}  // namespace tacto::gui

#include "moc_MeasurementSummary.cpp"
