#include "app/gui/pilot/SeatRows.h"

#include <QGuiApplication>
#include <QScreen>
#include <QSettings>

#include "app/gui/theme/Building.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"
#include "core/pilot/StudyWords.h"

namespace tacto::gui {

namespace {

constexpr const char* kScreenKey = "pilot/screen";
constexpr const char* kMarkersKey = "pilot/markers";
constexpr const char *kNoMarkers = "off", *kByLsl = "lsl";
constexpr const char* kWholeSession = "pilot-identification";

QString rememberedMarkers() { return QSettings().value(kMarkersKey, kNoMarkers).toString(); }

QStringList markerWords(const FieldForm& form) { return form.text("markers").split(' ', Qt::SkipEmptyParts); }

/// Returns nothing if no markers are wanted by TCP.
std::optional<Result<MarkerAddress>> markersFrom(const FieldForm& form) {
    auto words = markerWords(form);
    words.removeIf([](const QString& word) { return word.compare(kByLsl, Qt::CaseInsensitive) == 0; });
    if (words.isEmpty() || words == QStringList(kNoMarkers)) return std::nullopt;
    return MarkerAddress::parse(words.join(' ').toStdString());
}

}  // namespace

std::vector<FormField> procedureFields() {
    return {choiceField("protocol", QObject::tr("What is run"),
                        {{kWholeSession, QObject::tr("the whole session")},
                         {"pilot-thresholds", QObject::tr("thresholds alone")}},
                        QObject::tr("Thresholds, training, test and ratings; or only the first part: what is just "
                                    "felt, and what is too strong.")),
            choiceField("method", QObject::tr("Detection by"),
                        {{"quest", QObject::tr("QUEST+")}, {"staircase", QObject::tr("weighted staircase")}},
                        QObject::tr("How the level that is just felt is found after the ascending limits."))};
}

void followOffer(FieldForm& form, const UnfinishedOffer& offer) {
    if (offer.goesOn()) form.set("protocol", qtext(offer.offered()->protocol));
    if (offer.goesOn() && !offer.offered()->language.isEmpty()) form.set("language", offer.offered()->language);
    for (const char* field : {"protocol", "method", "language"}) form.setFieldEnabled(field, !offer.goesOn());
}

bool sayRefused(TroubleLine& line, const FieldForm& form) {
    const auto why = form.refusal();
    if (!why.isEmpty() || line.property("refused").toBool()) line.say(why);
    line.setProperty("refused", !why.isEmpty());
    return !why.isEmpty();
}

bool isWholeSession(const FieldForm& form) { return form.text("protocol") == kWholeSession; }

SeatRows::SeatRows(FieldForm& form)
    : form_(form), screen_(new ScreenChoice), inputs_(new InputRows), about_(new QLabel(&form)) {
    about_->setWordWrap(true);
    about_->setObjectName("seatsAbout");
    setTone(*about_, Tone::Quiet);
}

std::vector<FormField> SeatRows::fields() const {
    const auto key = [](KeySet set) { return QString::number(int(set)); };
    return {choiceField("language", QObject::tr("Their language"), {{"en", "English"}},
                        QObject::tr("All that the participant reads. Another language is a file words/CODE.json in the "
                                    "study’s folder.")),
            ownField(QObject::tr("Their screen"), screen_),
            choiceField("answerKeys", QObject::tr("Their keys"),
                        {{key(KeySet::Figures), QObject::tr("figures 1 to 6")},
                         {key(KeySet::LeftHand), QObject::tr("left hand: W E, S D, X C")},
                         {key(KeySet::RightHand), QObject::tr("right hand: U I, J K, M and comma")}},
                        QObject::tr("Touch and mouse work with each of them.")),
            ownField(QObject::tr("Game pads, pedals"), inputs_),
            textField("markers", QObject::tr("Markers, TCP or LSL"), rememberedMarkers(),
                      QObject::tr("“off”, or the port at which a recorder of EEG or EMG on this computer connects: "
                                  "5005. For one on another computer an address of this one too: 192.168.1.20:5005. A "
                                  "line for each event with its time, and nothing of conditions, answers or people. "
                                  "“lsl”, also behind a port: the same by Lab Streaming Layer, as the stream "
                                  "Tactoscope-markers, to all that its settings reach. Needs liblsl, and real time."),
                      kNoMarkers),
            tickField("blind", QObject::tr("Blind: conditions and answers are hidden"), true)};
}

void SeatRows::connectFields() {
    QObject::connect(form_.findChild<QLineEdit*>("markers"), &QLineEdit::editingFinished, &form_,
                     [this] { QSettings().setValue(kMarkersKey, form_.text("markers")); });
    setBlind(false);
    form_.set("blind", "true");
}

void SeatRows::offerWords(const QString& folder, const std::vector<WordsHash>& approved) {
    const auto all = languagesOf(folder.toStdString());
    wordsTrouble_ = all ? QString() : sentence(all.error());
    std::vector<std::pair<QString, QString>> choices;
    for (const auto& each : all ? *all : ParticipantWords::builtIn()) {
        if (approved.empty() || std::ranges::count(approved, each.sha256(), &WordsHash::sha256) > 0)
            choices.emplace_back(qtext(each.code()), qtext(each.language()));
    }
    if (choices.empty())
        wordsTrouble_ = QObject::tr("None of the words that the approval states is there; an amendment states others.");
    else
        form_.setChoices("language", choices);
}

void SeatRows::writeTo(PilotStart& start) const {
    start.language = form_.text("language");
    start.protocol = form_.text("protocol").toStdString();
    start.method = form_.text("method").toStdString();
    start.keys = KeySet(form_.text("answerKeys").toInt());
    start.blind = form_.text("blind") == "true";
    start.inputs = inputs_->seats();
    start.buttons = inputs_->devices();
    const auto to = markersFrom(form_);
    start.markers = to && *to ? std::optional(**to) : std::nullopt;
    start.lsl.outlets = markerWords(form_).contains(kByLsl, Qt::CaseInsensitive);
}

QString SeatRows::missing(bool person) const {
    if (form_.refused(false) > 0) return QObject::tr("Correct the field that is refused first.");
    if (const auto to = markersFrom(form_); to && !*to) return sentence(to->error());
    if (!wordsTrouble_.isEmpty()) return wordsTrouble_;
    return person ? inputs_->missing() : QString();
}

void SeatRows::recall(const QString& place) {
    inputs_->setPlace(place);
    form_.set("markers", rememberedMarkers());
}

void SeatRows::setBlind(bool study) {
    form_.set("blind", study ? "true" : "false");
    form_.setFieldEnabled("blind", !study);
    form_.findChild<QWidget*>("blind")->setToolTip(
        study ? QObject::tr("Blind is what the study’s approval says; an amendment changes it.")
              : QObject::tr("The operator sees no condition, level or answer until the session has ended."));
}

void SeatRows::showFor(bool person, const QString& lasts) {
    form_.setRowVisible("language", person);
    form_.setRowVisible(*screen_, person);
    form_.setRowVisible("answerKeys", person);
    form_.setRowVisible(*inputs_, person);
    about_->setText(
        !person
            ? QObject::tr("The virtual participant answers every question of both people, and the session takes %1. "
                          "The next page shows what happens; where it is not blind, Live and Oscilloscope show what is "
                          "delivered.")
                  .arg(lasts.isEmpty() ? QObject::tr("seconds") : lasts)
        : ScreenChoice::isOnly()
            ? QObject::tr("There is one screen: the participant’s window covers it. F2 opens your strip on "
                          "it, and Esc stops from anywhere.")
            : QObject::tr("Their window opens on the screen chosen above; this one stays yours."));
    if (person && form_.findChild<QWidget*>("blind")->isEnabledTo(&form_))
        about_->setText(about_->text() +
                        QObject::tr(" Nothing is felt here: without “Blind” their screen says what it would be."));
}

ScreenChoice::ScreenChoice(QWidget* parent) : QComboBox(parent) {
    nameWidget(*this, "participantScreen", tr("The participant’s screen"),
               tr("Where the participant’s window opens, full screen. Remembered by name."));
    fill();
    connect(this, &QComboBox::activated, this, [this] { QSettings().setValue(kScreenKey, chosenName()); });
    connect(qGuiApp, &QGuiApplication::screenAdded, this, [this](const QScreen* screen) {
        const bool wanted = screen->name() == chosenName();
        fill();
        if (wanted) emit back(screen->name());
    });
    connect(qGuiApp, &QGuiApplication::screenRemoved, this, [this](const QScreen* screen) {
        const auto name = screen->name();
        if (name == chosenName()) emit lost(name);
        if (name != chosenName()) fill();
    });
}

/// Chooses the remembered screen; otherwise a screen that is not the operator's; otherwise the only screen.
void ScreenChoice::fill() {
    const auto before = currentIndex() >= 0 ? chosenName() : QSettings().value(kScreenKey).toString();
    clear();
    for (const auto* screen : QGuiApplication::screens()) {
        const auto size = screen->geometry().size();
        addItem(tr("%1, %2 × %3").arg(screen->name()).arg(size.width()).arg(size.height()), screen->name());
    }
    int index = findData(before);
    if (index < 0) {
        index = 0;
        for (int i = 0; i < count(); ++i) {
            if (itemData(i).toString() != QGuiApplication::primaryScreen()->name()) index = i;
        }
    }
    setCurrentIndex(index);
}

QScreen* ScreenChoice::chosen() const {
    for (auto* screen : QGuiApplication::screens()) {
        if (screen->name() == chosenName()) return screen;
    }
    return nullptr;
}

QScreen* ScreenChoice::seat() {
    if (chosen() == nullptr) fill();
    return chosen();
}

bool ScreenChoice::isOnly() { return QGuiApplication::screens().size() < 2; }

}  // namespace tacto::gui

#include "moc_SeatRows.cpp"
