#include "app/gui/pilot/SeatRows.h"

#include <QSettings>

#include "app/gui/pilot/ScreenChoice.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {

constexpr const char* kMarkersKey = "pilot/markers";
constexpr const char* kNoMarkers = "off";

/// Nothing where none are wanted.
std::optional<Result<MarkerAddress>> markersFrom(const QLineEdit& line) {
    const auto text = line.text().trimmed();
    if (text.isEmpty() || text == kNoMarkers) return std::nullopt;
    return MarkerAddress::parse(text.toStdString());
}

}  // namespace

SeatRows::SeatRows(QFormLayout& form, QWidget& parent)
    : form_(form),
      screen_(new ScreenChoice(&parent)),
      keys_(new QComboBox(&parent)),
      inputs_(new InputRows(&parent)),
      markers_(new QLineEdit(QSettings().value(kMarkersKey, kNoMarkers).toString(), &parent)),
      blind_(new QCheckBox(QObject::tr("Blind: conditions and answers are hidden"), &parent)),
      about_(new QLabel(&parent)) {
    form.addRow(QObject::tr("Their screen"), screen_);
    keys_->setObjectName("answerKeys");
    keys_->addItem(QObject::tr("figures 1 to 6"), int(KeySet::Figures));
    keys_->addItem(QObject::tr("left hand: W E, S D, X C"), int(KeySet::LeftHand));
    keys_->addItem(QObject::tr("right hand: U I, J K, M and comma"), int(KeySet::RightHand));
    keys_->setToolTip(QObject::tr("Touch and mouse work with each of them."));
    form.addRow(QObject::tr("Their keys"), keys_);
    form.addRow(QObject::tr("Game pads, pedals"), inputs_);
    markers_->setObjectName("markers");
    markers_->setAccessibleName(QObject::tr("Markers: off, or the TCP port"));
    markers_->setPlaceholderText(kNoMarkers);
    markers_->setToolTip(
        QObject::tr("“off”, or the port at which a recorder of EEG or EMG on this computer connects: 5005. For one on "
                    "another computer an address of this one too: 192.168.1.20:5005. A line for each event with its "
                    "time, and nothing of conditions, answers or people."));
    QObject::connect(markers_, &QLineEdit::editingFinished, markers_,
                     [this] { QSettings().setValue(kMarkersKey, markers_->text().trimmed()); });
    form.addRow(QObject::tr("Markers, TCP port"), markers_);
    blind_->setObjectName("blind");
    setBlind(false);
    blind_->setChecked(true);
    form.addRow(blind_);
    about_->setWordWrap(true);
    about_->setObjectName("seatsAbout");
    setTone(*about_, Tone::Quiet);
}

void SeatRows::writeTo(PilotStart& start) const {
    start.keys = KeySet(keys_->currentData().toInt());
    start.blind = blind_->isChecked();
    start.inputs = inputs_->seats();
    start.buttons = inputs_->devices();
    const auto to = markersFrom(*markers_);
    start.markers = to && *to ? std::optional(**to) : std::nullopt;
}

QString SeatRows::missing(bool person) const {
    if (const auto to = markersFrom(*markers_); to && !*to) return sentence(to->error());
    return person ? inputs_->missing() : QString();
}

void SeatRows::recall(const QString& place) {
    inputs_->setPlace(place);
    markers_->setText(QSettings().value(kMarkersKey, kNoMarkers).toString());
}

void SeatRows::setBlind(bool study) {
    blind_->setChecked(study);
    blind_->setEnabled(!study);
    blind_->setToolTip(study ? QObject::tr("Blind is what the study’s approval says; an amendment changes it.")
                             : QObject::tr("The operator sees no condition, level or answer until the session has "
                                           "ended."));
}

void SeatRows::showFor(bool person, bool realTime) {
    form_.setRowVisible(screen_, person);
    form_.setRowVisible(keys_, person);
    form_.setRowVisible(inputs_, person);
    about_->setText(
        !person && realTime
            ? QObject::tr("The virtual participant answers every question of both people, and the session takes about "
                          "an hour. Where it is not blind, Live and Oscilloscope show what is delivered.")
        : !person
            ? QObject::tr(
                  "The virtual participant answers every question of both people, and the session is done in seconds.")
        : ScreenChoice::isOnly()
            ? QObject::tr("There is one screen: the participant’s window covers it. F2 opens your strip on "
                          "it, and Esc stops from anywhere.")
            : QObject::tr("Their window opens on the screen chosen above; this one stays yours."));
}

}  // namespace tacto::gui
