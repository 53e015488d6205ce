#include "app/gui/sessions/ExportDialog.h"

#include <QLocale>

#include "app/gui/theme/Building.h"
#include "app/gui/theme/Dialogs.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"
#include "core/base/ProgramVersion.h"

namespace tacto::gui {

namespace {

constexpr int kExportChars = 72;  // width in characters
constexpr int kThousandths = 1000;

QString sizeText(std::uint64_t bytes) {
    return QLocale(QLocale::English).formattedDataSize(qint64(bytes), 1, QLocale::DataSizeSIFormat);
}

QString leftOutText(const std::vector<LeftOut>& leftOut) {
    if (leftOut.empty()) return ExportDialog::tr("Nothing is left out.");
    QStringList lines{ExportDialog::tr("Left out:")};
    for (const auto& [what, why] : leftOut) lines << QStringLiteral("• %1: %2").arg(qtext(what), qtext(why));
    return lines.join('\n');
}

}  // namespace

Result<ExportReport> exportWith(const WorkPort& port, const std::filesystem::path& session, const ExportFormat& format,
                                const std::filesystem::path& out) {
    return exportSession(session, format, out, programVersion().version,
                         {.stopped = [&] { return port.stopped(); },
                          .progress = [&](double share) { port.progress(int(share * kThousandths), kThousandths); }});
}

ExportDialog::ExportDialog(std::filesystem::path session, QWidget* parent)
    : QDialog(parent), session_(std::move(session)) {
    setWindowTitle(
        tr("Export %1 of %2").arg(qtext(session_.filename().string()), qtext(session_.parent_path().string())));
    auto* layout = new QVBoxLayout(this);
    layout->addWidget(heading(tr("Export %1").arg(qtext(session_.stem().string())), this));
    form_ = new FieldForm(this, FieldForm::Labels::Beside);
    addFormats(false);
    layout->addWidget(form_);
    holds_ = makeLabel({}, {.name = "exportHolds", .wraps = true, .plain = true, .selectable = true}, this);
    says_ =
        makeLabel(tr("Reading the session…"),
                  {.name = "exportSays", .tone = Tone::Quiet, .wraps = true, .plain = true, .selectable = true}, this);
    progress_ = new QProgressBar(this);
    progress_->setRange(0, kThousandths);
    nameWidget(*progress_, "exportProgress", tr("How much is exported"));
    progress_->hide();
    addAll(*layout, {holds_, says_, progress_, buildButtons()});
    connect(form_, &FieldForm::edited, this, &ExportDialog::showFormat);
    connect(&work_, &Background::progressed, progress_, [this](int done, int) { progress_->setValue(done); });
    const int wide = fontMetrics().averageCharWidth() * kExportChars;
    resize(wide, layout->totalHeightForWidth(wide));
    growWithContent(*this);
    showFormat();
    look();
}

void ExportDialog::addFormats(bool ofCalibration) {
    std::vector<std::pair<QString, QString>> formats;
    for (const auto* each : exportFormats()) formats.emplace_back(qtext(each->name), qtext(each->title));
    if (ofCalibration) formats.emplace_back("dcc", qtext(exportFormat("dcc")->title));
    form_->show({choiceField("format", tr("&Format"), formats, tr("What other programs read.")),
                 ownField(tr("&Where"), buildPlace())});
}

QWidget* ExportDialog::buildPlace() {
    auto* holder = new QWidget(this);
    auto* row = rowIn(*holder);
    place_ = new QLineEdit(holder);
    nameWidget(*place_, "exportPlace", tr("Where"), tr("A new file or folder: nothing is replaced."));
    choose_ = pageButton(tr("&Choose…"), "exportChoose", tr("Chooses a folder and a name."), holder);
    connect(choose_, &QPushButton::clicked, this, &ExportDialog::askPlace);
    connect(place_, &QLineEdit::textChanged, this, [this](const QString& text) {
        if (export_ != nullptr) export_->setEnabled(source_ && !work_.busy() && !text.isEmpty());
    });
    row->addWidget(place_, 1);
    row->addWidget(choose_);
    return holder;
}

QWidget* ExportDialog::buildButtons() {
    auto* holder = new QWidget(this);
    auto* row = rowIn(*holder);
    folder_ = pageButton(tr("&Show in folder"), "exportFolder", tr("Opens the folder that holds it."), holder);
    connect(folder_, &QPushButton::clicked, this, [this] {
        if (const auto why = openOnDesktop(qtext(made_.parent_path().string())); !why.isEmpty()) says_->setText(why);
    });
    folder_->hide();
    export_ = pageButton(tr("E&xport"), "exportBegin", tr("Verifies the session, then exports it."), holder);
    makePrimary(*export_);
    connect(export_, &QPushButton::clicked, this, &ExportDialog::begin);
    close_ = pageButton(tr("Cancel"), "exportClose", tr("Leaves nothing behind."), holder);
    connect(close_, &QPushButton::clicked, this, &QDialog::reject);
    row->addWidget(folder_);
    row->addStretch();
    addAll(*row, {export_, close_});
    return holder;
}

const ExportFormat& ExportDialog::format() const { return *exportFormat(form_->text("format").toStdString()); }

/// Reads what there is to export.
void ExportDialog::look() {
    using Read = std::shared_ptr<const ExportSource>;
    work_.take(
        [session = session_](const WorkPort& port) -> Result<Read> {
            auto source = ExportSource::open(session, nullptr, {.stopped = [&] { return port.stopped(); }},
                                             programVersion().version);
            if (!source) return failure(source);
            return std::make_shared<const ExportSource>(std::move(*source));
        },
        [this](const Result<Read>& read) {
            if (!read) return says_->setText(tr("Cannot be exported: %1").arg(qtext(read.error().message)));
            source_ = *read;
            says_->clear();
            if (source_->about().protocol == "stimulator-calibration") addFormats(true);
            showFormat();
        });
}

void ExportDialog::showFormat() {
    const auto& chosen = format();
    const auto name = session_.stem().string() +
                      (chosen.suffix.empty() ? "-" + std::string(chosen.name) : std::string(chosen.suffix));
    const auto before = std::filesystem::path(place_->text().toStdString()).parent_path();
    place_->setText(qtext(((before.empty() ? session_.parent_path() : before) / name).string()));
    export_->setEnabled(source_ && !work_.busy());
    if (!source_) return;
    QStringList lines;
    if (chosen.size != nullptr) lines << tr("About %1.").arg(sizeText(chosen.size(*source_)));
    if (!source_->marks().empty()) lines << tr("Marked: %1.").arg(qtext(source_->marksText()));
    lines << leftOutText(leftOutOf(*source_, chosen));
    holds_->setText(lines.join('\n'));
}

void ExportDialog::askPlace() {
    const auto now = std::filesystem::path(place_->text().toStdString());
    askForFile(*this,
               {.title = tr("Export to"),
                .wants = FileQuestion::Wants::NewFile,
                .folder = qtext(now.parent_path().string()),
                .name = qtext(now.filename().string())},
               [this](const QString& path) { place_->setText(path); });
}

void ExportDialog::begin() {
    for (QWidget* each : {static_cast<QWidget*>(form_), static_cast<QWidget*>(export_)}) each->setEnabled(false);
    says_->setText(tr("Exporting…"));
    progress_->setValue(0);
    progress_->show();
    work_.take([session = session_, &chosen = format(), out = std::filesystem::path(place_->text().toStdString())](
                   const WorkPort& port) { return exportWith(port, session, chosen, out); },
               [this](const Result<ExportReport>& done) { ended(done); });
}

void ExportDialog::ended(const Result<ExportReport>& done) {
    form_->setEnabled(true);
    export_->setEnabled(true);
    progress_->hide();
    if (!done) return says_->setText(tr("Not exported: %1").arg(qtext(done.error().message)));
    made_ = done->out;
    // What the format found out only while it wrote stands here too.
    holds_->setText(leftOutText(done->leftOut));
    std::uint64_t bytes = 0;
    for (const auto& file : done->files) bytes += file.bytes;
    says_->setText(tr("Exported: %1.").arg(sizeText(bytes)) +
                   (done->damaged ? tr(" The session is damaged: what can be read is there, and every file says so.")
                                  : QString()));
    folder_->show();
    close_->setText(tr("Close"));
    close_->setToolTip({});
}

}  // namespace tacto::gui
