#include "app/gui/study/StudyPage.h"

#include <QHBoxLayout>
#include <QVBoxLayout>

#include "app/gui/study/NewStudyPage.h"
#include "app/gui/study/PassphraseDialog.h"
#include "app/gui/study/StudyList.h"
#include "app/gui/theme/Dialogs.h"
#include "app/gui/theme/Pages.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {
constexpr int kNonePad = 16;
}

StudyPage::StudyPage(OpenStudy& study, QWidget* parent)
    : QWidget(parent), study_(study), pages_(new PageStack(this)), new_(new NewStudyPage(study, pages_)) {
    setObjectName("studyPage");
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->addWidget(pages_);
    pages_->addWidget(buildNone());
    pages_->addWidget(new_);
    auto* list = new ScrollingPage(pages_);
    list_ = new StudyList(study_, list->viewport());
    list->hold(list_);
    pages_->addWidget(list);
    connect(new_, &NewStudyPage::cancelled, this, [this] { pages_->setCurrentIndex(kNone); });
    connect(list_, &StudyList::sessionWanted, this, &StudyPage::sessionWanted);
    connect(&study_, &OpenStudy::opened, this, [this] {
        if (asks_) asks_->accept();
        say({});
        list_->sayWhatHinders();
        pages_->setCurrentIndex(kList);
    });
    connect(&study_, &OpenStudy::refused, this, [this](const QString& why) {
        if (asks_)
            asks_->refuse(why);
        else if (pages_->currentIndex() == kList)
            list_->say(why);
        else
            say(why);
    });
    connect(&study_, &OpenStudy::changed, this, [this] {
        if (study_.folder().isEmpty() && pages_->currentIndex() == kList) pages_->setCurrentIndex(kNone);
    });
}

QWidget* StudyPage::buildNone() {
    auto* around = new ScrollingPage(pages_);
    auto* page = new QWidget(around->viewport());
    auto* column = new QVBoxLayout(page);
    column->setContentsMargins(kNonePad, kNonePad, kNonePad, kNonePad);
    column->setSpacing(12);
    column->addWidget(heading(tr("A study"), page));
    column->addWidget(explanation(
        tr("A study has an approval, participants known by codes, their consents, and sessions that are sealed under a "
           "passphrase. Virtual participants can be enrolled like anyone, so that everything is tried before a person "
           "sits down."),
        page));
    trouble_ = new TroubleLine("openTrouble", page);
    column->addWidget(trouble_);
    auto* row = new QHBoxLayout;
    row->setSpacing(8);
    auto* open = new QPushButton(tr("Open a study…"), page);
    open->setObjectName("openStudy");
    open->setToolTip(tr("By its folder, which holds study.json."));
    makePrimary(*open);
    auto* create = new QPushButton(tr("New study…"), page);
    create->setObjectName("newStudyWanted");
    create->setToolTip(tr("Its approval and settings first, then a passphrase."));
    for (auto* button : {open, create}) {
        button->setAutoDefault(false);
        row->addWidget(button);
    }
    row->addStretch();
    column->addLayout(row);
    column->addStretch();
    connect(open, &QPushButton::clicked, this, &StudyPage::chooseFolder);
    connect(create, &QPushButton::clicked, this, [this] {
        say({});
        new_->clear();
        pages_->setCurrentIndex(kNew);
    });
    around->hold(page);
    return around;
}

void StudyPage::chooseFolder() {
    FileQuestion question;
    question.title = tr("The study’s folder");
    question.wants = FileQuestion::Wants::Folder;
    askForFile(*this, question, [this](const QString& path) { open(path); });
}

void StudyPage::open(const QString& folder) {
    const auto look = study_.look(folder);
    if (!look) return say(sentence(look.error()));
    say({});
    if (!look->sealed) return study_.open(folder, nullptr);
    asks_ = new PassphraseDialog(PassphraseDialog::Purpose::Open, look->title, this);
    connect(asks_, &PassphraseDialog::given, this, [this, folder] { study_.open(folder, asks_->passphrase()); });
    connect(asks_, &PassphraseDialog::givenUp, &study_, &OpenStudy::giveUpOpening);
    openDialog(asks_);
}

void StudyPage::say(const QString& what) { trouble_->say(what); }

}  // namespace tacto::gui

#include "moc_StudyPage.cpp"
