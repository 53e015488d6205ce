#include "app/gui/calibrate/CalibrationCard.h"

#include "app/gui/theme/Building.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"
#include "app/gui/theme/ToolRow.h"

namespace tacto::gui {

namespace {

constexpr int kNameChars = 27;   // "simulated stimulator · SIM-1"
constexpr int kStateChars = 44;  // "✔ calibrated 12 d ago, until 2027-11-27", which may wrap
constexpr int kApart = 8;

QString nameOf(const StimulatorId& one) {
    const auto name = QString::fromStdString(one.name);
    return one.serial.empty() ? name : QString("%1 · %2").arg(name, QString::fromStdString(one.serial));
}

/// Returns, for example, "oscilloscope X (serial), its own calibration due 2027-03-01".
QString instrumentText(const CalibrationInstrument& one) {
    const auto due = !one.due ? QObject::tr("its own due date was not stated")
                     : *one.due < utcToday()
                         ? QObject::tr("⚠ its own calibration was due %1").arg(qtext(dateText(*one.due)))
                         : QObject::tr("its own calibration due %1").arg(qtext(dateText(*one.due)));
    const auto name = QString::fromStdString(one.name);
    return one.serial.empty() ? QObject::tr("%1 (%2)").arg(name, due)
                              : QObject::tr("%1 %2 (%3)").arg(name, QString::fromStdString(one.serial), due);
}

QString factsOf(const StoredCalibration& c) {
    const auto unit = QString::fromStdString(c.unit);
    QStringList facts;
    const auto within = [](const StoredLine& line) { return quantityText(line.uncertainty_pct, "%", 2); };
    facts << QObject::tr("Delivers %1 times the command%2, ± %3 (95 %), from %4 to %5")
                 .arg(decimalText(c.amplitude.gain, 4),
                      c.amplitude.offset < 0 ? QObject::tr(" less %1").arg(quantityText(-c.amplitude.offset, unit, 2))
                                             : QObject::tr(" plus %1").arg(quantityText(c.amplitude.offset, unit, 2)),
                      within(c.amplitude), settingText(c.amplitude.lowest, unit),
                      settingText(c.amplitude.highest, unit));
    QStringList times;  // the table shows their fitted lines
    for (const auto& time : kStoredTimes) {
        const auto title = QString::fromUtf8(time.words.data(), qsizetype(time.words.size()));
        if (const auto& line = c.*time.line) times << QString("%1 ± %2").arg(title, within(*line));
    }
    if (!times.isEmpty()) facts << times.join(", ");
    facts << QObject::tr("made %1, valid until %2").arg(qtext(dateText(c.made)), qtext(dateText(c.validUntil)));
    QStringList instruments;
    for (const auto& one : c.instruments) instruments << instrumentText(one);
    if (!instruments.isEmpty()) facts << QObject::tr("with %1").arg(instruments.join(", "));
    if (c.simulated) facts << QObject::tr("simulated");
    return facts.join(" · ");
}

}  // namespace

CalibrationCard::CalibrationCard(CalibrationBook& book, QWidget* parent) : QFrame(parent), book_(book) {
    nameWidget(*this, "calibrationCard", tr("Calibration of the stimulator"));
    setFrameShape(QFrame::StyledPanel);
    auto* column = columnIn(*this, 4, {8, 8, 8, 8});
    word_ = makeLabel({}, {.name = "calibrationState", .size = TextSize::Large, .wraps = true}, this);
    chooser_ = new QComboBox(this);
    nameWidget(
        *chooser_, "stimulatorChooser", tr("Stimulator"),
        tr("Whose calibration is shown: the stimulator that is open, those plugged in, and those calibrated before. "
           "Which one is calibrated is chosen under Wiring."));
    chooser_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    chooser_->setMinimumContentsLength(kNameChars);
    connect(chooser_, &QComboBox::currentIndexChanged, this, [this](int index) {
        if (index >= 0 && index < int(listed_.size())) tell(listed_[std::size_t(index)]);
        emit stimulatorChosen();
    });
    calibrate_ = new QPushButton(tr("Calibrate"), this);
    calibrate_->setObjectName("calibrateButton");
    calibrate_->setToolTip(
        tr("Runs the whole calibration with the settings below, and keeps its result for the stimulator's serial "
           "number. An older one is superseded and stays in the list."));
    connect(calibrate_, &QPushButton::clicked, this, &CalibrationCard::calibrateWanted);
    check_ = new QPushButton(tr("Check"), this);
    check_->setObjectName("checkButton");
    connect(check_, &QPushButton::clicked, this, &CalibrationCard::checkWanted);
    auto* buttons = new QHBoxLayout;
    for (auto* button : {calibrate_, check_}) {
        button->setAutoDefault(false);
        buttons->addWidget(button);
    }
    auto* act = new TurningRow;
    act->addWidget(chooser_, 1);
    act->addLayout(buttons);
    auto* row = new TurningRow(
        [this, act] { return fontMetrics().averageCharWidth() * kStateChars + act->sizeHint().width(); });
    row->addWidget(word_, 1);
    row->addLayout(act);
    for (auto* each : {act, row}) each->setSpacing(kApart);
    column->addLayout(row);
    facts_ = makeLabel({}, {.name = "calibrationFacts", .wraps = true, .selectable = true}, this);
    column->addWidget(facts_);
    connect(&book_, &CalibrationBook::changed, this, &CalibrationCard::fill);
    fill();
    afterLookChange(*this, [this] { colour(); });
    onEvent(*this, QEvent::Show, [this] {
        book_.read();  // the command line may have added a calibration
    });
}

std::optional<StimulatorId> CalibrationCard::shown() const {
    const int index = chooser_->currentIndex();
    if (index < 0 || index >= int(listed_.size())) return std::nullopt;
    return listed_[std::size_t(index)];
}

void CalibrationCard::fill() {
    // A stimulator just opened is shown; otherwise the operator's choice stays.
    auto wanted = shown();
    if (book_.last() != lastOpen_ || !wanted) wanted = book_.last();
    lastOpen_ = book_.last();
    listed_ = book_.known();
    {
        const QSignalBlocker quiet(chooser_);
        chooser_->clear();
        int current = 0;
        for (const auto& one : listed_) {
            if (wanted && wanted->serial == one.serial) current = chooser_->count();
            chooser_->addItem(nameOf(one));
        }
        chooser_->setCurrentIndex(listed_.empty() ? -1 : current);
    }
    chooser_->setVisible(!listed_.empty());
    if (const auto chosen = shown()) {
        tell(*chosen);
    } else {
        counts_ = warns_ = false;
        word_->setText(tr("◌ No stimulator has been open yet"));
        facts_->setText(
            tr("A calibration says what a stimulator really delivers for what it is programmed to, and with which "
               "uncertainty. "
               "Calibrate runs it on the devices named under Wiring: as they stand, the simulated bench."));
        colour();
        setReady(ready_);
    }
    emit stimulatorChosen();
}

void CalibrationCard::tell(const StimulatorId& stimulator) {
    const auto standing = book_.standing(stimulator);
    counts_ = standing.state == CalibrationState::Valid;
    warns_ = !counts_;
    word_->setText((counts_ ? "✔ " : "⚠ ") + standingText(standing));
    QStringList facts;
    if (!counts_) facts << standing.why + tr(" An uncalibrated stimulator is for bench loads only.");
    if (standing.newest) facts << factsOf(*standing.newest) + ".";
    facts_->setText(facts.join("\n"));
    word_->setToolTip(standingTip(standing));
    colour();
    setReady(ready_);
}

void CalibrationCard::setReady(bool ready) {
    ready_ = ready;
    calibrate_->setEnabled(ready);
    check_->setEnabled(ready && counts_);
    check_->setToolTip(
        counts_ ? tr("Three levels of each quantity, up and down: does the stored calibration still hold? Takes a few "
                     "minutes; nothing is stored.")
                : tr("There is no valid calibration to check. Calibrate first."));
}

void CalibrationCard::colour() {
    // Set by a style sheet, since a label loses its own palette when the theme's sheet changes.
    const auto& ink = counts_ ? colours().passText : warns_ ? colours().amberText : colours().text;
    const auto sheet = QString("QLabel { color: %1; }").arg(ink.name());
    if (word_->styleSheet() != sheet) word_->setStyleSheet(sheet);
}

}  // namespace tacto::gui

#include "moc_CalibrationCard.cpp"
