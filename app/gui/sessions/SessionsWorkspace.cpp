#include "app/gui/sessions/SessionsWorkspace.h"

#include <QDragEnterEvent>
#include <QFileInfo>
#include <QMimeData>
#include <algorithm>
#include <utility>

#include "app/gui/runner/ReportView.h"
#include "app/gui/sessions/CompareWindow.h"
#include "app/gui/sessions/ExportDialog.h"
#include "app/gui/theme/Building.h"
#include "app/gui/theme/Dialogs.h"
#include "app/gui/theme/Icons.h"
#include "app/gui/theme/Labels.h"
#include "app/gui/theme/Pages.h"
#include "app/gui/theme/Text.h"
#include "core/session/SessionReader.h"
#include "core/session/SessionVerify.h"

namespace tacto::gui {

namespace {

constexpr int kPanesFrom = 820;  // width in pixels from which both panes are side by side
constexpr int kListMargin = 16, kAroundActions = 12;

constexpr std::uint64_t kMaxValuesDrawn = 4'000'000;

bool holdsTouch(const ReadSession& session) {
    return std::ranges::any_of(session.streams, [](const auto& info) {
        const auto& kind = info.stream.kind;
        return info.samples > 0 && (kind == "acceleration" || kind == "force" || kind == "taxels");
    });
}

}  // namespace

SessionsWorkspace::SessionsWorkspace(BenchController& controller, QWidget* parent)
    : QWidget(parent), controller_(controller), reports_(this) {
    setAcceptDrops(true);
    auto* layout = columnIn(*this, 0);
    auto* split = split_ = new QSplitter(Qt::Horizontal, this);
    split->setChildrenCollapsible(false);
    auto* left = new QWidget(split);
    list_ = new SessionList(left);
    layOut(*left, *list_, *buildListActions());
    auto* right = new QWidget(split);
    details_ = new SessionDetails(controller_.limits(), right);
    layOut(*right, *details_, *buildSessionActions());
    split->setStretchFactor(0, 3);
    split->setStretchFactor(1, 2);
    layout->addWidget(split, 1);
    layout->addWidget(buildNews());
    connect(details_, &SessionDetails::labelsRefused, this, &SessionsWorkspace::say);
    connect(details_, &SessionDetails::labelsSaved, this,
            [this](const QString& session) { list_->confirm(session.toStdString()); });
    connect(details_, &SessionDetails::captureActivated, this, &SessionsWorkspace::openCapture);
    connect(details_, &SessionDetails::streamChosen, this, &SessionsWorkspace::drawStream);
    connect(&controller_, &BenchController::changed, this, [this] {
        if (isVisible()) rescan();
    });
    connect(list_, &SessionList::selectionChanged, this, &SessionsWorkspace::chosen);
    const auto showBusy = [this] {
        progress_->setVisible(list_->scan().busy() || work_.busy());
        cancel_->setVisible(work_.busy());
    };
    for (const auto* task : {&list_->scan(), static_cast<const Background*>(&work_)}) {
        connect(task, &Background::progressed, progress_, [this](int done, int total) {
            progress_->setRange(0, total);
            progress_->setValue(done);
        });
        connect(task, &Background::busyChanged, this, showBusy);
    }
    connect(&reports_, &ReportMaker::done, this, [this](const QString& out) {
        say(tr("The report is written: %1").arg(out));
        showReport(out);
    });
    connect(&reports_, &ReportMaker::failed, this, &SessionsWorkspace::say);
    showBusy();
    chosen();
    fitPanes();
    onFontChange(*this, [this] { fitPanes(); });
    onEvent(*this, QEvent::Resize, [this] { fitPanes(); });
    onEvent(*this, QEvent::Show, [this] { rescan(); });
}

/// Fits the panes to the visible width, since a page that scrolls is as wide as its parts ask for. If the panes do not
/// fit side by side, the session is placed below the list.
void SessionsWorkspace::fitPanes() {
    const int room = widthInSight(*this);
    actions_.dress(room);
    split_->setOrientation(room < scaledPx(kPanesFrom) ? Qt::Vertical : Qt::Horizontal);
}

/// Lays out a pane: its content, and below it the buttons for that content.
void SessionsWorkspace::layOut(QWidget& pane, QWidget& shown, QWidget& actions) {
    auto* column = columnIn(pane, 0);
    column->addWidget(&shown, 1);
    makeActionBar(actions);
    column->addWidget(&actions);
}

QWidget* SessionsWorkspace::buildListActions() {
    auto* holder = new QWidget(this);
    auto* row = rowIn(*holder, -1, {kListMargin, kAroundActions, kListMargin, kAroundActions});
    compare_ = actions_.add(*row, "compare", tr("Co&mpare two"), tr("Shows the differences between two sessions."),
                            [this] { compare(); });
    actions_.add(*row, "verify", tr("Verif&y"),
                 tr("Is it what was recorded? Checks every row and sample against the chain."), [this] { verify(); });
    actions_
        .add(*row, "export", tr("E&xport…"),
             tr("Its streams, trials, trains, events and captures, for other programs."), [this] { askExport(); })
        ->setObjectName("exportSession");
    row->addStretch();
    auto* hint = new ElidedLabel(tr("Ctrl+click: choose a second session · Ctrl+F: search"), holder);
    hint->setToolTip(hint->text());
    hint->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
    setTone(*hint, Tone::Quiet);
    setTextSize(*hint, TextSize::Small);
    row->addWidget(hint, 1);
    return holder;
}

QWidget* SessionsWorkspace::buildSessionActions() {
    auto* holder = new QWidget(this);
    auto* row = rowIn(*holder, -1, {kListMargin, kAroundActions, kListMargin, kAroundActions});
    auto* report = actions_.add(*row, "report", tr("Rep&ort"), tr("The report as PDF, from the session alone."),
                                [this] { makeReport(); });
    report->setIcon(icon("report", Ink::Primary));
    makePrimary(*report);
    replay_ = actions_.add(*row, "run", tr("Replay"), tr("Its fingertip, replayed into the simulated stimulator."),
                           [this] { replay(); });
    capture_ = actions_.add(*row, "single", tr("Open &capture"),
                            tr("The capture chosen under Captures, in the oscilloscope."), [this] {
                                if (const auto seq = details_->chosenCapture()) openCapture(*seq);
                            });
    row->addStretch();
    makeQuiet(*actions_.add(*row, "open", tr("Show in folder"), tr("Opens the folder that holds it."),
                            [this] { showInFolder(); }));
    return holder;
}

QWidget* SessionsWorkspace::buildNews() {
    auto* holder = new QWidget(this);
    auto* below = new QHBoxLayout(holder);
    below->setContentsMargins(kListMargin, 0, kListMargin, 0);  // takes no height while there is no message
    says_ = makeLabel({}, {.name = "sessionsSay", .wraps = true}, holder);
    says_->setContentsMargins(0, 0, 0, kListMargin / 2);
    says_->hide();
    says_->setTextInteractionFlags(Qt::TextSelectableByMouse);
    progress_ = new ProgressBar(holder);
    progress_->setMaximumWidth(fontMetrics().averageCharWidth() * 30);
    cancel_ = new QPushButton(tr("Cancel"), holder);
    cancel_->setToolTip(tr("Cancels what is under way. No half-written file is left."));
    connect(cancel_, &QPushButton::clicked, &work_, &Background::cancel);
    below->addWidget(says_, 1);
    addAll(*below, {progress_, cancel_});
    return holder;
}

void SessionsWorkspace::rescan() {
    const auto open = controller_.open();
    list_->rescan(open ? open->session : std::filesystem::path());
}

void SessionsWorkspace::chosen() {
    const auto rows = list_->selected();
    const auto* entry = list_->current();
    const QString none = rows.size() > 1    ? tr("Choose one session alone.")
                         : entry == nullptr ? tr("Choose a session first.")
                                            : entry->problem;
    actions_.offerAll(none);
    actions_.offer(compare_, rows.size() == 2 ? QString() : tr("Choose two sessions first (Ctrl+click)."));
    read_.reset();
    if (rows.size() == 2)
        return details_->say(tr("Two sessions are chosen: “Compare two” shows what differs between them."));
    if (entry == nullptr) return details_->say(tr("Choose a session at the left."));
    if (!entry->problem.isEmpty()) return details_->say(entry->problem);
    reading_.take(
        [path = entry->path](const WorkPort&) { return readSession(path); },
        [this](Result<ReadSession> read) {
            if (!read) return details_->say(qtext(read.error().message));
            read_ = std::make_shared<ReadSession>(std::move(*read));
            details_->show(read_);
            emit sessionShown(file());
            actions_.offer(capture_, read_->captures.empty() ? tr("This session holds no capture.") : QString());
            actions_.offer(replay_, holdsTouch(*read_) ? QString() : tr("This session holds no touch to replay."));
        });
}

void SessionsWorkspace::say(const QString& what) {
    says_->setText(what);
    says_->setVisible(!what.isEmpty());
}

QString SessionsWorkspace::file() const { return read_ ? qtext(read_->path.string()) : QString(); }

QString SessionsWorkspace::writtenReport() const {
    if (!read_) return {};
    auto report = read_->path;
    std::error_code error;
    const bool written = std::filesystem::is_regular_file(report.replace_extension(".pdf"), error);
    return written ? qtext(report.string()) : QString();
}

bool SessionsWorkspace::openSession(const QString& path) {
    const auto file = std::filesystem::absolute(path.toStdString()).lexically_normal();
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error)) {
        say(tr("%1 is not there.").arg(path));
        return false;
    }
    list_->add(file);
    rescan();
    return true;
}

void SessionsWorkspace::openCapture(qint64 seq) {
    if (!read_) return;
    work_.take(
        [path = read_->path, seq](const WorkPort&) {
            const auto reader = SessionReader::open(path);
            return reader ? reader->capture(seq) : failure(reader);
        },
        [this](Result<Capture> taken) {
            if (!taken) return say(qtext(taken.error().message));
            emit captureChosen(std::make_shared<Capture>(std::move(*taken)));
        });
}

void SessionsWorkspace::drawStream(int stream) {
    if (!read_) return;
    const auto info = std::ranges::find(read_->streams, stream, &SessionStreamInfo::id);
    if (info == read_->streams.end()) return;
    reading_.take(
        [path = read_->path, stream](const WorkPort&) {
            const auto reader = SessionReader::open(path);
            return reader ? reader->outline(stream, kMaxValuesDrawn) : failure(reader);
        },
        [this, info = *info](const Result<StreamOutline>& read) {
            if (!read) return say(qtext(read.error().message));
            details_->showStream(info, read->samples);
            const bool stands = says_->text() == saidOfStream_;
            saidOfStream_ =
                read->oneIn > 1 ? tr("The stream is long: of %1 stretches, one is drawn.").arg(read->oneIn) : QString();
            if (stands || read->oneIn > 1) say(saidOfStream_);
        });
}

void SessionsWorkspace::verify() {
    const auto* entry = list_->current();
    if (entry == nullptr) return;
    say(tr("Verifying…"));
    work_.take([path = entry->path](const WorkPort&) { return verifySession(path); },
               [this, name = qtext(entry->path.filename().string())](const Result<VerifyReport>& report) {
                   if (!report) return say(qtext(report.error().message));
                   QStringList words;
                   for (const auto& note : report->notes) words << qtext(note);
                   for (const auto& problem : report->problems) words << qtext(problem);
                   if (report->status == SessionStatus::Intact && reportChanged(*report))
                       say(tr("✖ %1 is intact, its report is not: %2").arg(name, words.join(" ")));
                   else if (report->status == SessionStatus::Intact)
                       say(tr("✔ %1 is intact: %2 rows, %3 samples. %4")
                               .arg(name)
                               .arg(report->rows)
                               .arg(report->samples)
                               .arg(words.join(" ")));
                   else
                       say(tr("✖ %1 is damaged: %2").arg(name, words.join(" ")));
               });
}

void SessionsWorkspace::makeReport() {
    const auto* entry = list_->current();
    if (entry == nullptr) return;
    auto out = entry->path;
    out.replace_extension(".pdf");
    say(tr("Drawing the report…"));
    work_.take(
        [path = entry->path, out](const WorkPort&) -> Result<std::vector<CheckedSignature>> {
            auto found = signaturesIn(path);
            if (!found) return failure(found);
            std::erase_if(*found, [&](const auto& each) { return path.parent_path() / each.report != out; });
            return checkSignatures(path, *found);
        },
        [this, path = entry->path, out](const Result<std::vector<CheckedSignature>>& found) {
            std::error_code error;
            const bool there = std::filesystem::exists(out, error);
            if (!found && there) return say(sentence(found.error()));
            if (!there || found->empty()) return reports_.make(qtext(path.string()), qtext(out.string()));
            // A drawing would take the place of what was signed.
            say(tr("%1 It is not drawn again.").arg(qtext(sentenceOf(found->back()))));
            showReport(qtext(out.string()));
        });
}

/// A report lies beside its session and has its name.
void SessionsWorkspace::showReport(const QString& pdf) {
    auto session = std::filesystem::path(pdf.toStdString());
    ReportWindow::showReport(*this, pdf, qtext(session.replace_extension(".tacto").string()));
}

void SessionsWorkspace::askExport() {
    if (const auto* entry = list_->current()) openDialog(new ExportDialog(entry->path, this));
}

void SessionsWorkspace::exportTo(const QString& folder) {
    if (const auto* entry = list_->current()) exportSession(entry->path, folder);
}

void SessionsWorkspace::exportSession(const std::filesystem::path& session, const QString& folder) {
    say(tr("Exporting…"));
    work_.start(
        [session, folder](const WorkPort& port) -> Result<void> {
            const auto done = exportWith(port, session, *exportFormat("csv"), folder.toStdString());
            return done ? Result<void>() : failure(done);
        },
        [this, folder](const Result<void>& done) {
            say(done ? tr("Exported to %1").arg(folder) : tr("Not exported: %1").arg(qtext(done.error().message)));
        });
}

void SessionsWorkspace::replay() {
    const auto* entry = list_->current();
    if (entry == nullptr) return;
    auto folder = std::make_unique<QTemporaryDir>();
    const auto target = folder->path() + "/" + qtext(entry->path.stem().string());
    replayed_ = std::move(folder);
    say(tr("Preparing the replay…"));
    work_.start(
        [path = entry->path, target](const WorkPort& port) -> Result<void> {
            const auto done = exportWith(port, path, *exportFormat("csv"), target.toStdString());
            return done ? Result<void>() : failure(done);
        },
        [this, target](const Result<void>& done) {
            if (!done) return say(tr("Cannot be replayed: %1").arg(qtext(done.error().message)));
            say({});
            emit recordingReady(target);
        });
}

void SessionsWorkspace::compare() {
    const auto rows = list_->selected();
    if (rows.size() != 2) return;
    using Both = std::array<std::shared_ptr<ReadSession>, 2>;
    work_.take(
        [paths = std::array{rows[0]->path, rows[1]->path}](const WorkPort&) -> Result<Both> {
            Both both;
            for (std::size_t i = 0; i < 2; ++i) {
                auto read = readSession(paths[i]);
                if (!read) return failure(read);
                both[i] = std::make_shared<ReadSession>(std::move(*read));
            }
            return both;
        },
        [this](const Result<Both>& both) {
            if (!both) return say(qtext(both.error().message));
            openDialog(new CompareWindow((*both)[0], (*both)[1], this));
        });
}

void SessionsWorkspace::showInFolder() {
    const auto* entry = list_->current();
    if (entry == nullptr) return;
    if (const auto why = openOnDesktop(qtext(entry->path.parent_path().string())); !why.isEmpty()) say(why);
}

void SessionsWorkspace::dragEnterEvent(QDragEnterEvent* event) {
    for (const auto& url : event->mimeData()->urls()) {
        if (url.toLocalFile().endsWith(".tacto")) return event->acceptProposedAction();
    }
}

void SessionsWorkspace::dropEvent(QDropEvent* event) {
    for (const auto& url : event->mimeData()->urls()) openSession(url.toLocalFile());
    event->acceptProposedAction();
}

namespace {
constexpr int kWordsFrom = 1020;  // width in pixels for both panes
}

QPushButton* ActionButtons::add(QBoxLayout& row, const char* iconName, const QString& text, const QString& tip,
                                std::function<void()> act) {
    auto* button = new QPushButton(icon(iconName), text, row.parentWidget());
    button->setAutoDefault(false);
    button->setAccessibleName(QString(text).remove('&'));
    QObject::connect(button, &QPushButton::clicked, button, std::move(act));
    row.addWidget(button);
    all_.push_back({button, text, tip, {}});
    explain(all_.back());
    return button;
}

void ActionButtons::explain(const Action& action) {
    const auto& says = action.refusal.isEmpty() ? action.tip : action.refusal;
    action.button->setToolTip(
        action.button->text().isEmpty() ? QString("%1: %2").arg(action.button->accessibleName(), says) : says);
}

void ActionButtons::offer(QPushButton* button, const QString& refusal) {
    const auto action = std::ranges::find(all_, button, &Action::button);
    action->refusal = refusal;
    button->setEnabled(refusal.isEmpty());
    explain(*action);
}

void ActionButtons::offerAll(const QString& refusal) {
    for (auto& action : all_) offer(action.button, refusal);
}

void ActionButtons::dress(int room) {
    const bool worded = room >= scaledPx(kWordsFrom);
    for (const auto& action : all_) {
        action.button->setText(worded ? action.text : QString());
        explain(action);
    }
}

}  // namespace tacto::gui

#include "moc_SessionsWorkspace.cpp"
