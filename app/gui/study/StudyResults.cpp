#include "app/gui/study/StudyResults.h"

#include <QFileInfo>
#include <QStackedWidget>

#include "app/gui/runner/ResultTables.h"
#include "app/gui/sessions/SessionPreview.h"
#include "app/gui/study/StudyDialogs.h"
#include "app/gui/theme/Building.h"
#include "app/gui/theme/Dialogs.h"
#include "app/gui/theme/Pages.h"
#include "app/gui/theme/PlotPicture.h"
#include "app/gui/theme/Text.h"
#include "app/report/FigureDrawing.h"
#include "core/base/JsonText.h"
#include "core/base/WholeFile.h"
#include "core/study/StudyFiles.h"

namespace tacto::gui {

namespace {

constexpr int kListWide = 300;

}  // namespace

StudyResults::StudyResults(OpenStudy& study, QWidget* parent)
    : QWidget(parent),
      study_(study),
      list_(new QListWidget(this)),
      pages_(new QStackedWidget(this)),
      said_(makeLabel({}, {.name = "resultsSaid", .wraps = true}, this)),
      save_(pageButton(tr("Save this figure…"), "saveFigure", tr("As SVG, PDF or PNG, outside the study’s folder."),
                       this)),
      saveAll_(pageButton(tr("Save all figures…"), "saveFigures",
                          tr("Each as SVG, in a new or empty folder outside the study’s folder."), this)),
      use_(pageButton(tr("Use the better encoding…"), "useBetter", {}, this)) {
    setObjectName("studyResults");
    auto* whole = columnIn(*this, 0);
    auto* row = new QHBoxLayout;
    row->setContentsMargins(kPagePad, kPagePad, kPagePad, kPagePad / 2);
    row->setSpacing(kPagePad);
    nameWidget(*list_, "resultsList", tr("Results and figures"));
    list_->setWordWrap(true);
    fixWidth(*list_, kListWide);
    row->addWidget(list_);
    auto* scrolling = new ScrollingPage(pages_);
    tables_ = new ResultTables(scrolling->viewport());
    scrolling->hold(tables_);
    pages_->addWidget(scrolling);
    auto* drawn = new QWidget(pages_);
    auto* column = columnIn(*drawn, 8, {0, 0, 0, 0});
    sheet_ = new SheetView(drawn);
    legend_ = makeLabel({}, {.name = "figureLegend", .tone = Tone::Quiet, .wraps = true}, drawn);
    column->addWidget(legend_);
    column->addWidget(sheet_, 1);
    pages_->addWidget(drawn);
    row->addWidget(pages_, 1);
    whole->addLayout(row, 1);
    auto* foot = addPageFoot(*whole, this, QBoxLayout::TopToBottom);
    foot->addWidget(said_);
    said_->hide();
    auto* buttons = new QHBoxLayout;
    auto* back = pageButton(tr("Back to the study"), "backFromResults", {}, this);
    makePrimary(*back);
    for (auto* button : {back, save_, saveAll_, use_}) buttons->addWidget(button);
    buttons->addStretch();
    foot->addLayout(buttons);
    connect(list_, &QListWidget::currentRowChanged, this, &StudyResults::choose);
    connect(back, &QPushButton::clicked, this, &StudyResults::backWanted);
    connect(save_, &QPushButton::clicked, this, &StudyResults::saveOne);
    connect(saveAll_, &QPushButton::clicked, this, &StudyResults::saveAll);
    connect(use_, &QPushButton::clicked, this, &StudyResults::useBetter);
}

void StudyResults::show(const StudyShown& shown) {
    shown_ = shown;
    list_->clear();
    for (const auto& part : shown_.parts) {
        const auto who = qtext(std::string(peopleOf(*valueFor(kSessionBases, part["basis"].get<std::string>()))));
        list_->addItem(tr("Sessions and encodings: %1").arg(who));
    }
    for (const auto& each : shown_.figures) list_->addItem(each.caption);
    for (int row = 0; row < list_->count(); ++row) list_->item(row)->setToolTip(list_->item(row)->text());
    saveAll_->setEnabled(!shown_.figures.empty());
    said_->hide();
    list_->setCurrentRow(0);
}

void StudyResults::choose(int row) {
    const auto parts = static_cast<int>(shown_.parts.size());
    const bool drawn = row >= parts;
    save_->setEnabled(drawn);
    use_->setEnabled(!better().isEmpty());
    use_->setToolTip(use_->isEnabled() ? tr("“%1”, for this study or for others, each by an amendment.").arg(better())
                                       : tr("Here no encoding is better by the sessions of people on real devices."));
    if (row < 0) return tables_->show(nlohmann::json::object());
    pages_->setCurrentIndex(drawn ? 1 : 0);
    if (!drawn) return tables_->show(shown_.parts[std::size_t(row)]);
    const auto& figure = shown_.figures[std::size_t(row - parts)];
    legend_->setText(figureLegend(figure.figure));
    legend_->setVisible(!legend_->text().isEmpty());
    sheet_->show(drawFigure(figure.figure, figure.simulated));
    nameWidget(*sheet_, "figure", figure.caption);
}

QString StudyResults::better() const {
    const auto row = std::size_t(std::max(0, list_->currentRow()));
    if (list_->currentRow() < 0 || row >= shown_.parts.size()) return {};
    const auto& part = shown_.parts[row];
    return textOr(part, "basis") == "person" ? qtext(textOr(part, "better")) : QString();
}

void StudyResults::useBetter() {
    QStringList found;
    for (const auto& each : textsOr(shown_.parts[std::size_t(list_->currentRow())], "sentences")) found << qtext(each);
    const UseOfEncoding use{better(), found.join("\n\n"),
                            [this, encoding = better()] { openDialog(amendDialog(study_, this, encoding)); },
                            [this](const Profile& profile) { saveProfile(profile); }};
    openDialog(useEncodingDialog(study_, use, this));
}

void StudyResults::saveProfile(const Profile& profile) {
    FileQuestion question{.title = tr("Where the new profile is saved"),
                          .wants = FileQuestion::Wants::NewFile,
                          .filters = {tr("Profiles (*.json)")},
                          .name = "swapped.json",
                          .suffix = "json"};
    askForFile(*this, question, [this, profile](const QString& path) {
        const auto written = writeWholeFile(path.toStdString(), dumpJson(toJson(profile), 2) + "\n");
        said_->setText(written ? tr("The profile is %1. A study whose approval states another assignment takes it by "
                                    "an amendment.")
                                     .arg(path)
                               : sentence(written.error()));
        said_->show();
    });
}

bool StudyResults::note(const QString& place) {
    auto* study = study_.study();
    const auto noted =
        study == nullptr ? Result<void>(fail(ErrorCode::Unsupported, "the study is not open any more"))
        : liesInside(place.toStdString(), study_.folder().toStdString())
            ? Result<void>(fail(ErrorCode::InvalidArgument,
                                "{} lies inside the study folder; a place outside is expected", place.toStdString()))
            : study->exported(QFileInfo(place).absoluteFilePath().toStdString(), "figures");
    said_->setVisible(!noted);
    if (!noted) said_->setText(sentence(noted.error()));
    return noted.has_value();
}

void StudyResults::saveOne() {
    const int row = list_->currentRow() - static_cast<int>(shown_.parts.size());
    if (row < 0) return;
    FileQuestion question{.title = tr("Where the figure is saved"),
                          .wants = FileQuestion::Wants::NewFile,
                          .filters = {tr("Pictures (*.svg *.pdf *.png)")},
                          .folder = QFileInfo(study_.folder()).absolutePath(),
                          .name = qtext(shown_.figures[std::size_t(row)].name) + ".svg",
                          .suffix = "svg"};
    askForFile(*this, question, [this, figure = shown_.figures[std::size_t(row)]](const QString& path) {
        if (!note(path)) return;
        const std::shared_ptr<PlotSheet> sheet = drawFigure(figure.figure, figure.simulated);
        const Still still(
            sheet->size(), [sheet](QCPPainter& painter) { sheet->paint(painter); }, {}, figure.caption);
        const auto failed = savePicture(still, path);
        said_->setText(failed ? *failed : tr("The figure is %1.").arg(path));
        said_->show();
    });
}

void StudyResults::saveAll() {
    FileQuestion question{.title = tr("A new or empty folder for the figures, outside the study"),
                          .wants = FileQuestion::Wants::NewFolder,
                          .folder = QFileInfo(study_.folder()).absolutePath()};
    askForFile(*this, question, [this](const QString& place) {
        const auto folder = place.toStdString();
        auto done = checkBidsFolder(folder);
        if (done && !note(place)) return;
        if (done) done = writeFigures(shown_.figures, folder);
        said_->setText(done ? tr("The figures lie in %1.").arg(place) : sentence(done.error()));
        said_->show();
    });
}

}  // namespace tacto::gui

#include "moc_StudyResults.cpp"
