#include "app/gui/pilot/RehearsalPage.h"

#include <QDateTime>
#include <QDir>
#include <QStandardPaths>
#include <QVBoxLayout>

#include "app/gui/pilot/ProcedureRows.h"
#include "app/gui/pilot/RememberedInputs.h"
#include "app/gui/pilot/UnfinishedOffer.h"
#include "app/gui/theme/Icons.h"
#include "app/gui/theme/Pages.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {

constexpr int kFormWide = 620;
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
      folder_(new FolderRow(newFolder(), tr("A new folder, or the folder of a rehearsal to continue."),
                            tr("The rehearsal’s folder"), this)),
      offer_(new UnfinishedOffer(this)),
      who_(new QComboBox(this)),
      pace_(new QComboBox(this)),
      seed_(new QSpinBox(this)),
      modality_(new QComboBox(this)),
      procedure_(new ProcedureRows("rehearsal", *this)),
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
    rows_ = new QFormLayout(holder);
    rows_->setContentsMargins(0, 4, 0, 0);
    rows_->setVerticalSpacing(8);
    rows_->setRowWrapPolicy(QFormLayout::WrapLongRows);
    addStudyRows();
    addParticipantRows();
    addSessionRows();
    seats_ = std::make_unique<SeatRows>(*rows_, *holder);
    seats_->recall(kRehearsals);
    setTabOrder(seats_->last(), begin_);
    column->addWidget(holder);
    column->addWidget(seats_->about());
    column->addStretch();
    page->hold(inside);
    whole->addWidget(page, 1);
    auto* foot = addPageFoot(*whole, this, QBoxLayout::TopToBottom);
    foot->addWidget(trouble_);
    begin_->setObjectName("beginRehearsal");
    begin_->setIcon(icon("run", Ink::Primary));
    begin_->setAutoDefault(false);
    makePrimary(*begin_);
    connect(begin_, &QPushButton::clicked, this, &RehearsalPage::beginWanted);
    foot->addWidget(begin_, 0, Qt::AlignLeft);
    connect(&seats_->inputs(), &InputRows::changed, this, &RehearsalPage::judge);
    connect(&seats_->markers(), &QLineEdit::textChanged, this, &RehearsalPage::judge);
    look();
}

/// Where it lies, and what was interrupted there.
void RehearsalPage::addStudyRows() {
    folder_->line().setObjectName("studyFolder");
    folder_->line().setAccessibleName(tr("Folder of the rehearsal"));
    rows_->addRow(tr("Folder"), folder_);
    rows_->addRow(offer_);
    connect(&folder_->line(), &QLineEdit::textChanged, this, &RehearsalPage::look);
    connect(offer_, &UnfinishedOffer::changed, this, &RehearsalPage::judge);
}

/// Who answers, and how fast.
void RehearsalPage::addParticipantRows() {
    who_->setObjectName("whoAnswers");
    who_->addItem(tr("a virtual participant"), false);
    who_->addItem(tr("you, in their window"), true);
    who_->setToolTip(tr("A virtual participant answers by itself. Either way nothing but simulated devices is used."));
    rows_->addRow(tr("Participant"), who_);
    pace_->setObjectName("rehearsalPace");
    pace_->addItem(tr("as fast as possible"), false);
    pace_->addItem(tr("the session’s own"), true);
    pace_->setToolTip(
        tr("As fast as possible: seconds. The session’s own: as long as with a person, to watch what is delivered."));
    rows_->addRow(tr("Pace"), pace_);
    seed_->setObjectName("rehearsalSeed");
    seed_->setRange(1, kMaxSeed);
    seed_->setButtonSymbols(QAbstractSpinBox::NoButtons);  // no seed is more than another
    seed_->setToolTip(tr("The same seed gives the same order, and the same virtual participant."));
    rows_->addRow(tr("Seed"), seed_);
    connect(seed_, &QSpinBox::valueChanged, this, &RehearsalPage::look);
    connect(who_, &QComboBox::currentIndexChanged, this, &RehearsalPage::judge);
    connect(pace_, &QComboBox::currentIndexChanged, this, &RehearsalPage::judge);
}

/// What is run, and on what.
void RehearsalPage::addSessionRows() {
    modality_->setObjectName("rehearsalModality");
    modality_->addItem(tr("electrodes"), qtext(nameOf(Modality::Electrodes)));
    modality_->addItem(tr("a massager"), qtext(nameOf(Modality::Massager)));
    modality_->setToolTip(
        tr("These devices make what is felt; a massager has a strength instead of a current. A rehearsal keeps the "
           "devices that it began with."));
    rows_->addRow(tr("Felt through"), modality_);
    procedure_->addTo(*rows_);
    blocks_->setObjectName("rehearsalBlocks");
    blocks_->setRange(1, kMaxBlocks);
    blocks_->setValue(5);
    blocks_->setToolTip(tr("Each block has 18 trials: four per condition and two empty."));
    rows_->addRow(tr("Blocks of the test"), blocks_);
    connect(procedure_, &ProcedureRows::changed, this, &RehearsalPage::judge);
}

PilotStart RehearsalPage::rehearsal() const {
    PilotStart made;
    made.folder = folder_->folder();
    made.title = made.folder.section('/', -1);
    made.seed = std::uint64_t(seed_->value());
    made.participant = fmt::format("virtual:{}", made.seed);
    made.person = who_->currentData().toBool();
    made.realTime = !made.person && pace_->currentData().toBool();
    made.who = made.person ? tr("you") : tr("virtual, seed %1").arg(made.seed);
    procedure_->writeTo(made);
    made.unfinished = offer_->chosen();
    made.massager = modality_->currentData() == qtext(nameOf(Modality::Massager));
    if (modality_->isEnabled()) made.modality = modality_->currentData().toString().toStdString();
    if (!offer_->goesOn()) made.blocks = blocks_->value();
    made.inputsOf = kRehearsals;
    seats_->writeTo(made);
    return made;
}

void RehearsalPage::look() {
    const auto known = modalityIn(folder_->folder());
    if (known) modality_->setCurrentIndex(modality_->findData(qtext(nameOf(*known))));
    modality_->setEnabled(!known);
    title_->setText(known ? tr("Another session of this rehearsal") : tr("A new rehearsal"));
    offer_->offer(unfinishedIn(folder_->folder(), fmt::format("virtual:{}", seed_->value())));
    judge();
}

void RehearsalPage::renew() { folder_->line().setText(newFolder()); }

void RehearsalPage::judge() {
    procedure_->follow(*offer_);
    const bool person = who_->currentData().toBool();
    rows_->setRowVisible(pace_, !person);
    seats_->showFor(person, pace_->currentData().toBool());
    blocks_->setEnabled(!offer_->goesOn() && procedure_->isWhole());
    const auto lacks = seats_->missing(person);
    begin_->setEnabled(offer_->isSettled() && lacks.isEmpty() && !folder_->folder().isEmpty());
    begin_->setToolTip(
        !lacks.isEmpty() ? lacks : tr("Opens both windows. Nothing is delivered before the checklist is answered."));
    begin_->setText(offer_->goesOn() ? tr("Go on with the rehearsal") : tr("Begin rehearsal"));
}

void RehearsalPage::say(const QString& what) { trouble_->say(what); }

}  // namespace tacto::gui

#include "moc_RehearsalPage.cpp"
