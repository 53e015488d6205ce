#include "app/gui/study/NewStudyPage.h"

#include <QDir>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QStandardPaths>
#include <QVBoxLayout>

#include "app/gui/theme/Dialogs.h"
#include "app/gui/theme/Pages.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {
constexpr int kNewPad = 16, kFormWide = 900;
}

NewStudyPage::NewStudyPage(OpenStudy& study, QWidget* parent)
    : QWidget(parent),
      study_(study),
      folder_(new FolderRow({},
                            tr("A new or empty folder. The study’s keys are kept elsewhere, in your own key folder."),
                            tr("A new or empty folder for the study"), this)),
      trouble_(new TroubleLine("newStudyTrouble", this)) {
    setObjectName("newStudy");
    auto* whole = new QVBoxLayout(this);
    whole->setContentsMargins(0, 0, 0, 0);
    whole->setSpacing(0);
    auto* page = new ScrollingPage(this);
    auto* inside = new QWidget(page->viewport());
    auto* column = new QVBoxLayout(inside);
    column->setContentsMargins(kNewPad, kNewPad, kNewPad, kNewPad);
    column->setSpacing(12);
    column->addWidget(heading(tr("A new study"), inside));
    column->addWidget(explanation(
        tr("As the ethics committee approved it. Settings and protocols are fixed with it: a later change is an "
           "amendment with a reference of its own. Participants, people and virtual ones, are enrolled afterwards."),
        inside));
    auto* place = new QWidget(inside);
    auto* row = new QHBoxLayout(place);
    row->setContentsMargins(0, 0, 0, 0);
    row->setSpacing(8);
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
    auto* below = new QVBoxLayout;
    below->setContentsMargins(kNewPad, 12, kNewPad, 12);
    below->setSpacing(8);
    below->addWidget(trouble_);
    auto* foot = new QHBoxLayout;
    foot->setSpacing(8);
    auto* create = new QPushButton(tr("Create the study…"), this);
    create->setObjectName("createStudy");
    create->setToolTip(tr("Asks for a passphrase, then makes folder and keys."));
    makePrimary(*create);
    auto* cancel = new QPushButton(tr("Back"), this);
    for (auto* button : {create, cancel}) {
        button->setAutoDefault(false);
        foot->addWidget(button);
    }
    foot->addStretch();
    below->addLayout(foot);
    whole->addLayout(below);
    connect(form_, &StudyForm::edited, trouble_, &QLabel::hide);
    connect(create, &QPushButton::clicked, this, &NewStudyPage::askForPassphrase);
    connect(cancel, &QPushButton::clicked, this, &NewStudyPage::cancelled);
    connect(&study_, &OpenStudy::opened, this, [this] {
        if (asks_) asks_->accept();
    });
    connect(&study_, &OpenStudy::refused, this, [this](const QString& why) {
        if (asks_) asks_->refuse(why);
    });
}

void NewStudyPage::clear() {
    const QDir documents(QStandardPaths::writableLocation(QStandardPaths::DocumentsLocation));
    folder_->line().setText(documents.filePath("Tactoscope/study"));
    form_->clear();
    trouble_->hide();
}

void NewStudyPage::askForPassphrase() {
    const auto settings = form_->read(study_.profile());
    const auto folder = folder_->folder();
    const auto why = !settings          ? sentence(settings.error())
                     : folder.isEmpty() ? tr("The folder is missing. A new or empty one is expected.")
                     : Study::isThere(folder.toStdString())
                         ? tr("%1 holds a study already. A new or empty folder is expected.").arg(folder)
                         : QString();
    trouble_->say(why);
    if (!why.isEmpty()) return;
    asks_ = new PassphraseDialog(PassphraseDialog::Purpose::New, qtext(settings->title), this);
    connect(asks_, &PassphraseDialog::given, this,
            [this, folder, settings = *settings] { study_.create(folder, settings, asks_->passphrase()); });
    openDialog(asks_);
}

}  // namespace tacto::gui

#include "moc_NewStudyPage.cpp"
