#include "app/gui/pilot/RehearsalPage.h"

#include <QDateTime>
#include <QDir>
#include <QHBoxLayout>
#include <QStandardPaths>
#include <QVBoxLayout>

#include "app/gui/pilot/RememberedInputs.h"
#include "app/gui/pilot/UnfinishedOffer.h"
#include "app/gui/theme/Dialogs.h"
#include "app/gui/theme/Icons.h"
#include "app/gui/theme/LookChange.h"
#include "app/gui/theme/PathField.h"
#include "app/gui/theme/ScrollingPage.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {

constexpr int kPagePad = 16, kFormWide = 620;
constexpr int kMaxBlocks = 10, kMaxSeed = 1'000'000;

QString newFolder() {
    const QDir documents(QStandardPaths::writableLocation(QStandardPaths::DocumentsLocation));
    return documents.filePath("Tactoscope/rehearsal-" + QDateTime::currentDateTime().toString("yyyyMMdd-HHmmss"));
}

/// The modality of the rehearsal there; nothing where there is none yet.
std::optional<Modality> modalityIn(const QString& folder) {
    if (folder.isEmpty() || !Study::isThere(folder.toStdString())) return std::nullopt;
    const auto study = Study::open(folder.toStdString(), nullptr, Study::Access::Read);
    return study && study->isRehearsal() ? std::optional(study->settings().modality) : std::nullopt;
}

/// What was interrupted of that virtual participant in the rehearsal there.
std::optional<Unfinished> unfinishedIn(const QString& folder, const std::string& participant) {
    if (folder.isEmpty() || !Study::isThere(folder.toStdString())) return std::nullopt;
    const auto study = Study::open(folder.toStdString(), nullptr, Study::Access::Read);
    if (!study || !study->isRehearsal()) return std::nullopt;
    const auto who = study->find(participant);
    if (!who) return std::nullopt;
    const auto found = unfinishedOf(*study, *who);
    return found ? *found : std::nullopt;
}

}  // namespace

RehearsalPage::RehearsalPage(QWidget* parent)
    : QWidget(parent),
      title_(new QLabel(this)),
      folder_(new PathField(newFolder(), tr("A new folder, or the folder of a rehearsal to continue."), this)),
      offer_(new UnfinishedOffer(this)),
      who_(new QComboBox(this)),
      pace_(new QComboBox(this)),
      seed_(new QSpinBox(this)),
      modality_(new QComboBox(this)),
      protocol_(new QComboBox(this)),
      method_(new QComboBox(this)),
      blocks_(new QSpinBox(this)),
      trouble_(new TroubleLine("rehearsalTrouble", this)),
      begin_(new QPushButton(tr("Begin rehearsal"), this)) {
    auto* whole = new QVBoxLayout(this);
    whole->setContentsMargins(0, 0, 0, 0);
    whole->setSpacing(0);
    auto* page = new ScrollingPage(this);
    auto* inside = new QWidget(page->viewport());
    auto* column = new QVBoxLayout(inside);
    column->setContentsMargins(kPagePad, kPagePad, kPagePad, kPagePad / 2);
    column->setSpacing(8);
    title_->setObjectName("rehearsalTitle");
    setTextSize(*title_, TextSize::Large);
    column->addWidget(title_);
    column->addWidget(explanation(
        tr("The whole session as participant and operator see it, on simulated devices: checklist, thresholds, "
           "training, test, ratings. No person receives any output."),
        inside));
    auto* holder = new QWidget(inside);
    boundWidth(*holder, kFormWide);
    auto* form = rows_ = new QFormLayout(holder);
    form->setContentsMargins(0, 4, 0, 0);
    form->setVerticalSpacing(8);
    form->setRowWrapPolicy(QFormLayout::WrapLongRows);

    auto* place = new QWidget(holder);
    auto* row = new QHBoxLayout(place);
    row->setContentsMargins(0, 0, 0, 0);
    folder_->setObjectName("studyFolder");
    folder_->setAccessibleName(tr("Folder of the rehearsal"));
    auto* choose = new QPushButton(tr("Ch&oose…"), place);
    choose->setAutoDefault(false);
    choose->setToolTip(tr("Chooses the folder from a list."));
    connect(choose, &QPushButton::clicked, this, [this] {
        FileQuestion question;
        question.title = tr("The rehearsal’s folder");
        question.wants = FileQuestion::Wants::NewFolder;
        askForFile(*this, question, [this](const QString& path) { folder_->setText(path); });
    });
    row->addWidget(folder_, 1);
    row->addWidget(choose);
    form->addRow(tr("Folder"), place);
    form->addRow(offer_);

    who_->setObjectName("whoAnswers");
    who_->addItem(tr("a virtual participant"), false);
    who_->addItem(tr("you, in their window"), true);
    who_->setToolTip(tr("A virtual participant answers by itself. Either way nothing but simulated devices is used."));
    form->addRow(tr("Participant"), who_);
    pace_->setObjectName("rehearsalPace");
    pace_->addItem(tr("as fast as possible"), false);
    pace_->addItem(tr("the session’s own"), true);
    pace_->setToolTip(
        tr("As fast as possible: seconds. The session’s own: as long as with a person, to watch what is delivered."));
    form->addRow(tr("Pace"), pace_);
    seed_->setObjectName("rehearsalSeed");
    seed_->setRange(1, kMaxSeed);
    seed_->setButtonSymbols(QAbstractSpinBox::NoButtons);  // no seed is more than another
    seed_->setToolTip(tr("The same seed gives the same order, and the same virtual participant."));
    form->addRow(tr("Seed"), seed_);
    modality_->setObjectName("rehearsalModality");
    modality_->addItem(tr("electrodes"), qtext(nameOf(Modality::Electrodes)));
    modality_->addItem(tr("a massager"), qtext(nameOf(Modality::Massager)));
    modality_->setToolTip(
        tr("These devices make what is felt; a massager has a strength instead of a current. A rehearsal keeps the "
           "devices that it began with."));
    form->addRow(tr("Felt through"), modality_);
    protocol_->setObjectName("rehearsalProtocol");
    protocol_->addItem(tr("the whole session"), "pilot-identification");
    protocol_->addItem(tr("thresholds alone"), "pilot-thresholds");
    protocol_->setToolTip(tr(
        "Thresholds, training, test and ratings; or only the first part: what is just felt, and what is too strong."));
    form->addRow(tr("What is run"), protocol_);
    method_->setObjectName("rehearsalMethod");
    method_->addItem(tr("QUEST+"), "quest");
    method_->addItem(tr("weighted staircase"), "staircase");
    method_->setToolTip(tr("How the level that is just felt is found after the ascending limits."));
    form->addRow(tr("Detection by"), method_);
    blocks_->setObjectName("rehearsalBlocks");
    blocks_->setRange(1, kMaxBlocks);
    blocks_->setValue(5);
    blocks_->setToolTip(tr("Each block has 18 trials: four per condition and two empty."));
    form->addRow(tr("Blocks of the test"), blocks_);
    seats_ = std::make_unique<SeatRows>(*form, *holder);
    seats_->recall(kRehearsals);
    setTabOrder(folder_, choose);
    setTabOrder(seats_->last(), begin_);
    column->addWidget(holder);
    column->addWidget(seats_->about());
    column->addStretch();
    page->hold(inside);
    whole->addWidget(page, 1);
    auto* edge = new QFrame(this);
    edge->setFrameShape(QFrame::HLine);
    edge->setForegroundRole(QPalette::Mid);
    whole->addWidget(edge);
    auto* foot = new QVBoxLayout;
    foot->setContentsMargins(kPagePad, 12, kPagePad, 12);
    foot->setSpacing(8);
    foot->addWidget(trouble_);
    begin_->setObjectName("beginRehearsal");
    begin_->setIcon(icon("run", Ink::Primary));
    begin_->setAutoDefault(false);
    makePrimary(*begin_);
    connect(begin_, &QPushButton::clicked, this, &RehearsalPage::beginWanted);
    foot->addWidget(begin_, 0, Qt::AlignLeft);
    whole->addLayout(foot);
    connect(folder_, &QLineEdit::textChanged, this, &RehearsalPage::look);
    connect(seed_, &QSpinBox::valueChanged, this, &RehearsalPage::look);
    connect(who_, &QComboBox::currentIndexChanged, this, &RehearsalPage::judge);
    connect(pace_, &QComboBox::currentIndexChanged, this, &RehearsalPage::judge);
    connect(protocol_, &QComboBox::currentIndexChanged, this, &RehearsalPage::judge);
    connect(offer_, &UnfinishedOffer::changed, this, &RehearsalPage::judge);
    connect(&seats_->inputs(), &InputRows::changed, this, &RehearsalPage::judge);
    connect(&seats_->markers(), &QLineEdit::textChanged, this, &RehearsalPage::judge);
    look();
}

PilotStart RehearsalPage::rehearsal() const {
    PilotStart made;
    made.folder = folder_->text().trimmed();
    made.title = made.folder.section('/', -1);
    made.seed = std::uint64_t(seed_->value());
    made.participant = fmt::format("virtual:{}", made.seed);
    made.person = who_->currentData().toBool();
    made.realTime = !made.person && pace_->currentData().toBool();
    made.who = made.person ? tr("you") : tr("virtual, seed %1").arg(made.seed);
    made.protocol = protocol_->currentData().toString().toStdString();
    made.method = method_->currentData().toString().toStdString();
    made.unfinished = offer_->chosen();
    made.massager = modality_->currentData() == qtext(nameOf(Modality::Massager));
    if (modality_->isEnabled()) made.modality = modality_->currentData().toString().toStdString();
    if (made.unfinished != "resume") made.blocks = blocks_->value();
    made.inputsOf = kRehearsals;
    seats_->writeTo(made);
    return made;
}

void RehearsalPage::look() {
    const auto known = modalityIn(folder_->text().trimmed());
    if (known) modality_->setCurrentIndex(modality_->findData(qtext(nameOf(*known))));
    modality_->setEnabled(!known);
    title_->setText(known ? tr("Another session of this rehearsal") : tr("A new rehearsal"));
    offer_->offer(unfinishedIn(folder_->text().trimmed(), fmt::format("virtual:{}", seed_->value())));
    judge();
}

void RehearsalPage::renew() { folder_->setText(newFolder()); }

void RehearsalPage::judge() {
    const bool goesOn = offer_->chosen() == "resume";
    if (goesOn) protocol_->setCurrentIndex(protocol_->findData(qtext(offer_->offered()->protocol)));
    const bool tests = protocol_->currentIndex() == 0;
    const bool person = who_->currentData().toBool();
    rows_->setRowVisible(pace_, !person);
    seats_->showFor(person, pace_->currentData().toBool());
    for (auto* field : {protocol_, method_}) field->setEnabled(!goesOn);
    blocks_->setEnabled(!goesOn && tests);
    const bool chosen = !offer_->asks() || !offer_->chosen().empty();
    const auto lacks = seats_->missing(person);
    begin_->setEnabled(chosen && lacks.isEmpty() && !folder_->text().trimmed().isEmpty());
    begin_->setToolTip(
        !lacks.isEmpty() ? lacks : tr("Opens both windows. Nothing is delivered before the checklist is answered."));
    begin_->setText(goesOn ? tr("Go on with the rehearsal") : tr("Begin rehearsal"));
}

void RehearsalPage::say(const QString& what) { trouble_->say(what); }

}  // namespace tacto::gui

#include "moc_RehearsalPage.cpp"
