#include "app/gui/study/StudyPage.h"

#include <QDir>
#include <QSettings>
#include <QStandardPaths>

#include "app/gui/study/StudyList.h"
#include "app/gui/study/StudyResults.h"
#include "app/gui/theme/Building.h"
#include "app/gui/theme/Dialogs.h"
#include "app/gui/theme/Pages.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {

constexpr int kFormWide = 900;
constexpr const char* kRecent = "recentStudies";  // of QSettings
constexpr qsizetype kMaxRecent = 4;

/// Returns a dialog that closes once the study is open, and asks again if the passphrase is refused.
PassphraseDialog* asksFor(OpenStudy& study, PassphraseDialog::Purpose purpose, const QString& title, QWidget* parent) {
    auto* asks = new PassphraseDialog(purpose, title, parent);
    QObject::connect(&study, &OpenStudy::opened, asks, &QDialog::accept);
    QObject::connect(&study, &OpenStudy::refused, asks, &PassphraseDialog::refuse);
    return asks;
}

void remember(const QString& folder) {
    auto folders = QSettings().value(kRecent).toStringList();
    folders.removeAll(folder);
    folders.prepend(folder);
    QSettings().setValue(kRecent, QStringList(folders.mid(0, kMaxRecent)));
}

}  // namespace

StudyPage::StudyPage(OpenStudy& study, QWidget* parent)
    : QWidget(parent), study_(study), pages_(new PageStack(this)), new_(new NewStudyPage(study, pages_)) {
    setObjectName("studyPage");
    auto* column = columnIn(*this);
    column->addWidget(pages_);
    pages_->addWidget(buildNone());
    pages_->addWidget(new_);
    auto* opened = new QWidget(pages_);
    auto* around = columnIn(*opened, 0);
    auto* list = new ScrollingPage(opened);
    list_ = new StudyList(study_, list->viewport());
    list->hold(list_);
    around->addWidget(list, 1);
    addPageFoot(*around, opened)->addWidget(list_->foot(), 1);
    pages_->addWidget(opened);
    results_ = new StudyResults(study_, pages_);
    pages_->addWidget(results_);
    connect(results_, &StudyResults::backWanted, this, [this] { pages_->setCurrentIndex(kList); });
    connect(&study_, &OpenStudy::resultsRead, this, [this](const StudyShown& shown) {
        results_->show(shown);
        pages_->setCurrentIndex(kResults);
    });
    connect(new_, &NewStudyPage::cancelled, this, &StudyPage::showNone);
    connect(list_, &StudyList::sessionWanted, this, &StudyPage::sessionWanted);
    connect(&study_, &OpenStudy::opened, this, [this] {
        say({});
        remember(study_.folder());
        list_->say({});
        pages_->setCurrentIndex(kList);
    });
    connect(&study_, &OpenStudy::refused, this, [this](const QString& why) {
        if (!asks_) pages_->currentIndex() == kList ? list_->say(why) : say(why);
    });
    connect(&study_, &OpenStudy::changed, this, [this] {
        if (!study_.folder().isEmpty()) return;
        results_->show({});
        if (pages_->currentIndex() >= kList) showNone();
    });
}

QWidget* StudyPage::buildNone() {
    auto* around = new ScrollingPage(pages_);
    auto* page = new QWidget(around->viewport());
    auto* column = columnIn(*page, 12, {kPagePad, kPagePad, kPagePad, kPagePad});
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
    open_ = pageButton(tr("Open a study…"), "openStudy", tr("By its folder, which holds study.json."), page);
    create_ =
        pageButton(tr("New study…"), "newStudyWanted", tr("Its approval and settings first, then a passphrase."), page);
    for (auto* button : {open_, create_}) row->addWidget(button);
    row->addStretch();
    column->addLayout(row);
    recent_ = new QVBoxLayout;
    column->addLayout(recent_);
    column->addStretch();
    showRecent();
    connect(open_, &QPushButton::clicked, this, &StudyPage::chooseFolder);
    connect(create_, &QPushButton::clicked, this, [this] {
        say({});
        new_->clear();
        pages_->setCurrentIndex(kNew);
    });
    around->hold(page);
    return around;
}

void StudyPage::showNone() {
    showRecent();
    pages_->setCurrentIndex(kNone);
}

/// Offers the studies that were open last, as far as they are still there.
void StudyPage::showRecent() {
    while (auto* item = recent_->takeAt(0)) {
        if (item->widget() != nullptr) item->widget()->deleteLater();
        delete item;
    }
    for (const auto& folder : QSettings().value(kRecent).toStringList()) {
        const auto look = study_.look(folder);
        if (!look) continue;
        const auto words =
            fontMetrics().elidedText(tr("%1, in %2").arg(look->title, folder), Qt::ElideMiddle, scaledPx(kFormWide));
        auto* button = pageButton(QString(words).replace("&", "&&"), "recentStudy", folder, trouble_->parentWidget());
        connect(button, &QPushButton::clicked, this, [this, folder] { open(folder); });
        recent_->addWidget(button, 0, Qt::AlignLeft);
    }
    const bool any = recent_->count() > 0;  // without a study there is nothing to open yet
    makePrimary(*open_, any);
    makePrimary(*create_, !any);
}

void StudyPage::chooseFolder() {
    FileQuestion question{.title = tr("The study’s folder"), .wants = FileQuestion::Wants::Folder};
    askForFile(*this, question, [this](const QString& path) { open(path); });
}

void StudyPage::open(const QString& folder) {
    const auto look = study_.look(folder);
    if (!look) return say(sentence(look.error()));
    say({});
    if (!look->sealed) return study_.open(folder, nullptr);
    asks_ = asksFor(study_, PassphraseDialog::Purpose::Open, look->title, this);
    connect(asks_, &PassphraseDialog::given, this, [this, folder] { study_.open(folder, asks_->passphrase()); });
    connect(asks_, &PassphraseDialog::givenUp, &study_, &OpenStudy::giveUpOpening);
    openDialog(asks_);
}

void StudyPage::say(const QString& what) { trouble_->say(what); }

NewStudyPage::NewStudyPage(OpenStudy& study, QWidget* parent)
    : QWidget(parent),
      study_(study),
      folder_(new FolderRow({},
                            tr("A new or empty folder. The study’s keys are kept elsewhere, in your own key folder."),
                            tr("A new or empty folder for the study"), this)),
      trouble_(new TroubleLine("newStudyTrouble", this)) {
    setObjectName("newStudy");
    auto* whole = columnIn(*this, 0);
    auto* page = new ScrollingPage(this);
    auto* inside = new QWidget(page->viewport());
    auto* column = columnIn(*inside, 12, {kPagePad, kPagePad, kPagePad, kPagePad});
    column->addWidget(heading(tr("A new study"), inside));
    column->addWidget(explanation(
        tr("Enter the study as the ethics committee approved it. This fixes settings and protocols: a later change "
           "is an amendment with its own reference. Participants, people or virtual, are enrolled afterwards."),
        inside));
    auto* place = new QWidget(inside);
    auto* row = rowIn(*place, 8);
    auto* word = new QLabel(tr("&Folder"), place);
    word->setBuddy(&folder_->line());
    folder_->line().setObjectName("newStudyFolder");
    folder_->line().setAccessibleName(tr("Folder of the new study"));
    row->addWidget(word);
    row->addWidget(folder_, 1);
    boundWidth(*place, kFormWide);
    column->addWidget(place);
    form_ = new StudyForm(inside);
    boundWidth(*form_, kFormWide);
    column->addWidget(form_);
    column->addStretch();
    page->hold(inside);
    whole->addWidget(page, 1);
    auto* below = addPageFoot(*whole, this, QBoxLayout::TopToBottom);
    below->addWidget(trouble_);
    auto* foot = new QHBoxLayout;
    create_ = pageButton(tr("Create the study…"), "createStudy",
                         tr("Asks for a passphrase, then makes folder and keys."), this);
    makePrimary(*create_);
    auto* cancel = pageButton(tr("Back"), "newStudyBack", {}, this);
    for (auto* button : {create_, cancel}) foot->addWidget(button);
    foot->addStretch();
    below->addLayout(foot);
    connect(form_, &StudyForm::edited, this, &NewStudyPage::judge);
    connect(&folder_->line(), &QLineEdit::textChanged, this, &NewStudyPage::judge);
    connect(create_, &QPushButton::clicked, this, &NewStudyPage::askForPassphrase);
    connect(cancel, &QPushButton::clicked, this, &NewStudyPage::cancelled);
}

void NewStudyPage::clear() {
    const QDir documents(QStandardPaths::writableLocation(QStandardPaths::DocumentsLocation));
    folder_->line().setText(documents.filePath("Tactoscope/study"));
    form_->clear();
    judge();
}

std::optional<StudySettings> NewStudyPage::judge() {
    auto settings = form_->read(study_.profile());
    const auto folder = folder_->folder();
    const auto why = !settings          ? sentence(settings.error())
                     : folder.isEmpty() ? tr("The folder is missing. A new or empty one is expected.")
                     : Study::isThere(folder.toStdString())
                         ? tr("%1 holds a study already. A new or empty folder is expected.").arg(folder)
                         : QString();
    trouble_->say(why);
    create_->setEnabled(why.isEmpty());
    if (!why.isEmpty()) return std::nullopt;
    return std::move(*settings);
}

void NewStudyPage::askForPassphrase() {
    const auto settings = judge();
    if (!settings) return;
    const auto folder = folder_->folder();
    auto* asks = asksFor(study_, PassphraseDialog::Purpose::New, qtext(settings->title), this);
    connect(asks, &PassphraseDialog::given, this,
            [this, asks, folder, settings = *settings] { study_.create(folder, settings, asks->passphrase()); });
    openDialog(asks);
}

}  // namespace tacto::gui

#include "moc_StudyPage.cpp"
