#include "app/gui/pilot/RehearsalPage.h"

#include <QDateTime>
#include <QDir>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QSettings>
#include <QStandardPaths>
#include <QVBoxLayout>

#include "app/gui/pilot/ScreenChoice.h"
#include "app/gui/theme/Dialogs.h"
#include "app/gui/theme/Icons.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {

constexpr int kPagePad = 16, kFormWide = 620;
constexpr int kMostBlocks = 10, kMostSeed = 1'000'000;

QString newFolder() {
    const QDir documents(QStandardPaths::writableLocation(QStandardPaths::DocumentsLocation));
    return documents.filePath("Tactoscope/rehearsal-" + QDateTime::currentDateTime().toString("yyyyMMdd-HHmmss"));
}

}  // namespace

RehearsalPage::RehearsalPage(QWidget* parent)
    : QWidget(parent),
      folder_(new QLineEdit(newFolder(), this)),
      who_(new QComboBox(this)),
      seed_(new QSpinBox(this)),
      blocks_(new QSpinBox(this)),
      blind_(new QCheckBox(tr("Hide conditions, levels and answers from the operator until the end"), this)),
      keys_(new QComboBox(this)),
      screen_(new ScreenChoice(this)),
      about_(new QLabel(this)),
      trouble_(new QLabel(this)),
      begin_(new QPushButton(tr("Begin rehearsal"), this)) {
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(kPagePad, kPagePad, kPagePad, kPagePad);
    column->setSpacing(12);
    column->addWidget(heading(tr("A new rehearsal"), this));
    column->addWidget(explanation(
        tr("The whole session as a participant and an operator live it, on simulated devices: checklist, thresholds, "
           "training, test, ratings. Nothing of it reaches a person. A study with people needs an approval, consents "
           "and a passphrase; it is made on the command line with “tactoscope-cli study create”."),
        this));
    auto* holder = new QWidget(this);
    holder->setMaximumWidth(scaledPx(kFormWide));
    auto* form = new QFormLayout(holder);
    form->setContentsMargins(0, 8, 0, 0);
    form->setVerticalSpacing(12);

    auto* place = new QWidget(holder);
    auto* row = new QHBoxLayout(place);
    row->setContentsMargins(0, 0, 0, 0);
    folder_->setObjectName("studyFolder");
    folder_->setAccessibleName(tr("Study folder"));
    folder_->setToolTip(tr("A new folder, or the folder of a rehearsal that goes on."));
    auto* choose = new QPushButton(tr("Ch&oose…"), place);
    choose->setAutoDefault(false);
    connect(choose, &QPushButton::clicked, this, [this] {
        FileQuestion question;
        question.title = tr("The study’s folder");
        question.wants = FileQuestion::Wants::Folder;
        askForFile(*this, question, [this](const QString& path) { folder_->setText(path); });
    });
    row->addWidget(folder_, 1);
    row->addWidget(choose);
    form->addRow(tr("Study folder"), place);

    who_->setObjectName("whoAnswers");
    who_->addItem(tr("a virtual participant: answers by itself, done in seconds"), false);
    who_->addItem(tr("you, at the participant’s window"), true);
    who_->setToolTip(tr("Either way nothing but simulated devices is used."));
    form->addRow(tr("Participant"), who_);
    seed_->setObjectName("rehearsalSeed");
    seed_->setRange(1, kMostSeed);
    seed_->setToolTip(tr("The same seed gives the same order, and the same virtual participant."));
    form->addRow(tr("Seed"), seed_);
    blocks_->setObjectName("rehearsalBlocks");
    blocks_->setRange(1, kMostBlocks);
    blocks_->setValue(5);
    blocks_->setToolTip(tr("Of 18 trials each: four of every condition and two empty ones."));
    form->addRow(tr("Blocks of the test"), blocks_);
    form->addRow(tr("Their screen"), screen_);
    keys_->setObjectName("answerKeys");
    keys_->addItem(tr("figures 1 to 6"), int(KeySet::Figures));
    keys_->addItem(tr("left hand: W E, S D, X C"), int(KeySet::LeftHand));
    keys_->addItem(tr("right hand: U I, J K, M and comma"), int(KeySet::RightHand));
    keys_->setToolTip(tr("Touch and mouse work with each of them."));
    form->addRow(tr("Their keys"), keys_);
    blind_->setChecked(true);
    blind_->setObjectName("blind");
    form->addRow(QString(), blind_);
    column->addWidget(holder);
    about_->setWordWrap(true);
    about_->setObjectName("rehearsalAbout");
    setTone(*about_, Tone::Quiet);
    column->addWidget(about_);
    trouble_->setWordWrap(true);
    trouble_->setObjectName("rehearsalTrouble");
    trouble_->setTextFormat(Qt::PlainText);
    setTone(*trouble_, Tone::Warning);
    trouble_->hide();
    column->addWidget(trouble_);
    begin_->setObjectName("beginRehearsal");
    begin_->setIcon(icon("run", Ink::Primary));
    begin_->setAutoDefault(false);
    begin_->setToolTip(tr("Opens both windows. Nothing is delivered before the checklist is answered."));
    makePrimary(*begin_);
    connect(begin_, &QPushButton::clicked, this, &RehearsalPage::beginWanted);
    column->addWidget(begin_, 0, Qt::AlignLeft);
    column->addStretch();
    connect(folder_, &QLineEdit::textChanged, this, &RehearsalPage::judge);
    connect(who_, &QComboBox::currentIndexChanged, this, &RehearsalPage::judge);
    judge();
}

Rehearsal RehearsalPage::rehearsal() const {
    return {.folder = folder_->text().trimmed(),
            .person = who_->currentData().toBool(),
            .seed = std::uint64_t(seed_->value()),
            .blocks = blocks_->value(),
            .blind = blind_->isChecked(),
            .keys = KeySet(keys_->currentData().toInt())};
}

void RehearsalPage::judge() {
    const bool person = who_->currentData().toBool();
    about_->setText(!person ? tr("The virtual participant answers every question of both people; you watch.")
                    : ScreenChoice::isOnly()
                        ? tr("There is one screen: the participant’s window covers it. F2 opens your strip on it, and "
                             "Esc stops from anywhere.")
                        : tr("Their window opens on the screen chosen above; this one stays yours."));
    const bool named = !folder_->text().trimmed().isEmpty();
    begin_->setEnabled(named);
}

void RehearsalPage::say(const QString& what) {
    trouble_->setText(what.isEmpty() ? QString() : "⚠ " + what);
    trouble_->setVisible(!what.isEmpty());
}

void RehearsalPage::setChangeable(bool changeable) { setEnabled(changeable); }

}  // namespace tacto::gui
