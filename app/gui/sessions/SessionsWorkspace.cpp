#include "app/gui/sessions/SessionsWorkspace.h"

#include <QDesktopServices>
#include <QDragEnterEvent>
#include <QFileInfo>
#include <QHeaderView>
#include <QMimeData>
#include <QShortcut>
#include <QSplitter>
#include <QUrl>
#include <QVBoxLayout>

#include "app/gui/look/Dialogs.h"
#include "app/gui/look/Look.h"
#include "app/gui/look/Text.h"
#include "app/gui/sessions/CompareWindow.h"
#include "app/gui/sessions/SessionExport.h"
#include "app/run/RunFiles.h"
#include "core/session/SessionReader.h"
#include "core/session/SessionVerify.h"

namespace tacto::gui {

namespace {

constexpr int kIndex = Qt::UserRole;

/// Sorts by what stands behind the text.
class SortedItem final : public QTableWidgetItem {
public:
    SortedItem(const QString& shown, const QVariant& key) : QTableWidgetItem(shown) { setData(Qt::UserRole + 1, key); }
    bool operator<(const QTableWidgetItem& other) const override {
        const auto a = data(Qt::UserRole + 1), b = other.data(Qt::UserRole + 1);
        return QVariant::compare(a, b) == QPartialOrdering::Less;
    }
};

QString durationText(double seconds) {
    const int s = int(seconds);
    return QString("%1:%2:%3").arg(s / 3600).arg(s / 60 % 60, 2, 10, QChar('0')).arg(s % 60, 2, 10, QChar('0'));
}

}  // namespace

SessionsWorkspace::SessionsWorkspace(BenchDesk& desk, QWidget* parent) : QWidget(parent), desk_(desk), reports_(this) {
    setAcceptDrops(true);
    auto* layout = new QVBoxLayout(this);
    auto* split = new QSplitter(Qt::Horizontal, this);
    split->setChildrenCollapsible(false);
    split->addWidget(buildList());
    details_ = new SessionDetails(split);
    split->addWidget(details_);
    split->setStretchFactor(0, 3);
    split->setStretchFactor(1, 2);
    layout->addWidget(split, 1);
    layout->addWidget(buildActions());
    connect(details_, &SessionDetails::captureActivated, this, &SessionsWorkspace::openCapture);
    connect(details_, &SessionDetails::streamChosen, this, &SessionsWorkspace::drawStream);
    connect(&desk_, &BenchDesk::changed, this, [this] {
        if (isVisible()) rescan();
    });
    connect(&scan_, &Background::progressed, progress_, [this](int done, int total) {
        progress_->setRange(0, total);
        progress_->setValue(done);
    });
    connect(&work_, &Background::progressed, progress_, [this](int done, int total) {
        progress_->setRange(0, total);
        progress_->setValue(done);
    });
    const auto showBusy = [this] {
        progress_->setVisible(scan_.busy() || work_.busy());
        cancel_->setVisible(work_.busy());
    };
    connect(&scan_, &Background::busyChanged, this, showBusy);
    connect(&work_, &Background::busyChanged, this, showBusy);
    connect(&reports_, &ReportMaker::done, this, [this](const QString& out) {
        say(tr("The report is written: %1").arg(out));
        QDesktopServices::openUrl(QUrl::fromLocalFile(out));
    });
    connect(&reports_, &ReportMaker::failed, this, &SessionsWorkspace::say);
    showBusy();
    chosen();
}

QWidget* SessionsWorkspace::buildList() {
    auto* holder = new QWidget;
    auto* column = new QVBoxLayout(holder);
    column->setContentsMargins(0, 0, 0, 0);
    search_ = new QLineEdit(holder);
    search_->setPlaceholderText(tr("Search: protocol, device, verdict, date, name"));
    search_->setClearButtonEnabled(true);
    search_->setAccessibleName(tr("Search"));
    search_->setToolTip(tr("Shows only sessions that contain every word (Ctrl+F)."));
    connect(search_, &QLineEdit::textChanged, this, &SessionsWorkspace::filter);
    auto* find = new QShortcut(QKeySequence::Find, this, nullptr, nullptr, Qt::WidgetWithChildrenShortcut);
    connect(find, &QShortcut::activated, search_, [this] { search_->setFocus(); });
    column->addWidget(search_);
    table_ = new QTableWidget(0, 7, holder);
    table_->setObjectName("sessionsTable");
    table_->setAccessibleName(tr("Sessions"));
    table_->setHorizontalHeaderLabels(
        {tr("Began"), tr("Protocol"), tr("Verdict"), tr("Duration"), tr("Size"), tr("Devices"), tr("File")});
    table_->verticalHeader()->hide();
    table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
    table_->setSelectionBehavior(QAbstractItemView::SelectRows);
    table_->setSelectionMode(QAbstractItemView::ExtendedSelection);
    table_->setAlternatingRowColors(true);
    table_->setSortingEnabled(true);
    table_->sortByColumn(0, Qt::DescendingOrder);
    table_->horizontalHeader()->setStretchLastSection(true);
    table_->setToolTip(tr("Every session of the sessions folder, newest first. Drop other *.tacto files here."));
    connect(table_, &QTableWidget::itemSelectionChanged, this, &SessionsWorkspace::chosen);
    column->addWidget(table_, 1);
    empty_ = new QLabel(tr("No session yet. Every open bench and every protocol run is recorded and appears here: open "
                           "the simulated bench (Ctrl+B) or run Separability."),
                        holder);
    empty_->setWordWrap(true);
    empty_->setAlignment(Qt::AlignCenter);
    column->addWidget(empty_);
    return holder;
}

QWidget* SessionsWorkspace::buildActions() {
    auto* holder = new QWidget(this);
    auto* column = new QVBoxLayout(holder);
    column->setContentsMargins(0, 0, 0, 0);
    auto* row = new QHBoxLayout;
    const auto add = [&](const QString& text, const QString& tip, auto slot) {
        auto* button = new QPushButton(text, holder);
        button->setToolTip(tip);
        button->setAutoDefault(false);
        connect(button, &QPushButton::clicked, this, slot);
        row->addWidget(button);
        actions_.push_back(button);
        return button;
    };
    add(tr("Open &capture"), tr("The capture chosen under Captures, in the oscilloscope."), [this] {
        if (const auto seq = details_->chosenCapture())
            openCapture(*seq);
        else
            say(tr("This session holds no capture."));
    });
    add(tr("&Replay"), tr("Its fingertip, replayed into the simulated stimulator."), &SessionsWorkspace::replay);
    add(tr("Re&port"), tr("The report as PDF, from the session alone."), &SessionsWorkspace::makeReport);
    add(tr("E&xport CSV…"), tr("A file per stream, trials, events, commands and captures."),
        &SessionsWorkspace::askExport);
    add(tr("&Verify"), tr("Is it what was recorded? Checks every row and sample against the chain."),
        &SessionsWorkspace::verify);
    add(tr("Show in &folder"), tr("Opens the folder that holds it."), &SessionsWorkspace::showInFolder);
    compare_ = add(tr("Co&mpare two"), tr("Choose two sessions (Ctrl+click): overlay and differences."),
                   &SessionsWorkspace::compare);
    row->addStretch();
    column->addLayout(row);
    auto* below = new QHBoxLayout;
    says_ = new QLabel(holder);
    says_->setObjectName("sessionsSay");
    says_->setWordWrap(true);
    says_->setTextInteractionFlags(Qt::TextSelectableByMouse);
    progress_ = new QProgressBar(holder);
    progress_->setMaximumWidth(fontMetrics().averageCharWidth() * 30);
    cancel_ = new QPushButton(tr("Cancel"), holder);
    cancel_->setToolTip(tr("Ends what is being done; nothing half-written stays."));
    connect(cancel_, &QPushButton::clicked, &work_, &Background::cancel);
    below->addWidget(says_, 1);
    below->addWidget(progress_);
    below->addWidget(cancel_);
    column->addLayout(below);
    return holder;
}

void SessionsWorkspace::showEvent(QShowEvent* event) {
    QWidget::showEvent(event);
    rescan();
}

void SessionsWorkspace::rescan() {
    const auto found = std::make_shared<std::vector<SessionEntry>>();
    const auto known = entries_;
    const auto others = others_;
    scan_.start(
        [found, known, others](const WorkPort& port) -> Result<void> {
            auto files = sessionFiles(userSessionsFolder());
            files.insert(files.end(), others.begin(), others.end());
            int done = 0;
            for (const auto& file : files) {
                if (port.stopped()) return fail(ErrorCode::Stopped, "cancelled");
                std::error_code error;
                const auto bytes = std::filesystem::file_size(file, error);
                const auto before = std::find_if(known.begin(), known.end(), [&](const auto& entry) {
                    return entry.path == file && entry.bytes == qint64(bytes) && entry.closed;
                });
                found->push_back(before != known.end() ? *before : readEntry(file));
                port.progress(++done, int(files.size()));
            }
            return {};
        },
        [this, found](const Result<void>& done) {
            if (!done) return;
            entries_ = std::move(*found);
            fillList();
        });
}

bool SessionsWorkspace::isRecording(const SessionEntry& entry) const {
    const auto open = desk_.open();
    return open && open->session == entry.path;
}

void SessionsWorkspace::fillList() {
    const auto* before = current();
    const auto keep = !wanted_.empty() ? wanted_ : before != nullptr ? before->path : std::filesystem::path();
    const QSignalBlocker quiet(table_);
    table_->setSortingEnabled(false);
    table_->setRowCount(int(entries_.size()));
    for (int i = 0; i < int(entries_.size()); ++i) {
        const auto& entry = entries_[std::size_t(i)];
        const auto verdict = !entry.problem.isEmpty()   ? tr("⚠ cannot be read")
                             : isRecording(entry)       ? tr("● recording")
                             : !entry.verdict.isEmpty() ? entry.verdict
                             : entry.closed             ? QString("–")
                                                        : tr("not ended in order");
        const auto cell = [&](int column, const QString& shown, const QVariant& key) {
            auto* item = new SortedItem(shown, key);
            item->setData(kIndex, i);
            item->setToolTip(entry.problem.isEmpty() ? qtext(entry.path.string()) : entry.problem);
            table_->setItem(i, column, item);
        };
        cell(0, entry.began.toString("yyyy-MM-dd HH:mm:ss"), entry.began);
        cell(1, entry.protocol + (entry.simulated ? tr(" · simulated") : QString()), entry.protocol);
        cell(2, verdict, verdict);
        cell(3, durationText(entry.duration_s), entry.duration_s);
        cell(4, tr("%1 MB").arg(double(entry.bytes) / 1e6, 0, 'f', 1), entry.bytes);
        cell(5, entry.devices, entry.devices);
        cell(6, qtext(entry.path.filename().string()), qtext(entry.path.string()));
    }
    table_->setSortingEnabled(true);
    table_->resizeColumnsToContents();
    table_->clearSelection();
    for (int row = 0; row < table_->rowCount(); ++row) {
        if (entries_[std::size_t(table_->item(row, 0)->data(kIndex).toInt())].path == keep) table_->selectRow(row);
    }
    wanted_.clear();
    empty_->setVisible(entries_.empty());
    filter();
    chosen();
}

void SessionsWorkspace::filter() {
    const auto wanted = search_->text().toLower().split(' ', Qt::SkipEmptyParts);
    for (int row = 0; row < table_->rowCount(); ++row) {
        const auto text = entries_[std::size_t(table_->item(row, 0)->data(kIndex).toInt())].searched();
        const bool fits =
            std::all_of(wanted.begin(), wanted.end(), [&](const auto& word) { return text.contains(word); });
        table_->setRowHidden(row, !fits);
    }
}

std::vector<std::size_t> SessionsWorkspace::selected() const {
    std::vector<std::size_t> found;
    for (const auto& index : table_->selectionModel()->selectedRows())
        found.push_back(std::size_t(index.data(kIndex).toInt()));
    return found;
}

const SessionEntry* SessionsWorkspace::current() const {
    const auto rows = selected();
    return rows.size() == 1 && rows[0] < entries_.size() ? &entries_[rows[0]] : nullptr;
}

void SessionsWorkspace::chosen() {
    const auto rows = selected();
    const auto* entry = current();
    for (auto* button : actions_) button->setEnabled(entry != nullptr && entry->problem.isEmpty());
    compare_->setEnabled(rows.size() == 2);
    read_.reset();
    if (rows.size() == 2) return details_->say(tr("Two sessions: compare them."));
    if (entry == nullptr) return details_->say(tr("Choose a session at the left."));
    if (!entry->problem.isEmpty()) return details_->say(entry->problem);
    const auto session = std::make_shared<ReadSession>();
    reading_.start(
        [path = entry->path, session](const WorkPort&) -> Result<void> {
            auto read = readSession(path);
            if (!read) return failure(read);
            *session = std::move(*read);
            return {};
        },
        [this, session](const Result<void>& done) {
            if (!done) return details_->say(qtext(done.error().message));
            read_ = session;
            details_->show(session);
        });
}

void SessionsWorkspace::say(const QString& what) { says_->setText(what); }

bool SessionsWorkspace::openSession(const QString& path) {
    const auto file = std::filesystem::absolute(path.toStdString()).lexically_normal();
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error)) {
        say(tr("%1 is not there.").arg(path));
        return false;
    }
    const auto listed = std::any_of(entries_.begin(), entries_.end(), [&](const auto& e) { return e.path == file; });
    if (!listed && file.parent_path() != userSessionsFolder()) others_.insert(file);
    wanted_ = file;
    rescan();
    return true;
}

void SessionsWorkspace::openCapture(qint64 seq) {
    if (!read_) return;
    const auto capture = std::make_shared<Capture>();
    work_.start(
        [path = read_->path, seq, capture](const WorkPort&) -> Result<void> {
            const auto reader = SessionReader::open(path);
            if (!reader) return failure(reader);
            auto taken = reader->capture(seq);
            if (!taken) return failure(taken);
            *capture = std::move(*taken);
            return {};
        },
        [this, capture](const Result<void>& done) {
            if (!done) return say(qtext(done.error().message));
            emit captureChosen(capture);
        });
}

void SessionsWorkspace::drawStream(int stream) {
    if (!read_) return;
    const auto samples = std::make_shared<SampleBlock>();
    const auto info =
        std::find_if(read_->streams.begin(), read_->streams.end(), [&](const auto& s) { return s.id == stream; });
    if (info == read_->streams.end()) return;
    reading_.start(
        [path = read_->path, stream, samples](const WorkPort&) -> Result<void> {
            const auto reader = SessionReader::open(path);
            if (!reader) return failure(reader);
            auto read = reader->samples(stream);
            if (!read) return failure(read);
            *samples = std::move(*read);
            return {};
        },
        [this, samples, info = *info](const Result<void>& done) {
            if (!done) return say(qtext(done.error().message));
            details_->showStream(info, *samples);
        });
}

void SessionsWorkspace::verify() {
    const auto* entry = current();
    if (entry == nullptr) return;
    const auto report = std::make_shared<VerifyReport>();
    say(tr("Verifying…"));
    work_.start(
        [path = entry->path, report](const WorkPort&) -> Result<void> {
            auto verified = verifySession(path);
            if (!verified) return failure(verified);
            *report = std::move(*verified);
            return {};
        },
        [this, report, name = qtext(entry->path.filename().string())](const Result<void>& done) {
            if (!done) return say(qtext(done.error().message));
            QStringList words;
            for (const auto& note : report->notes) words << qtext(note);
            for (const auto& problem : report->problems) words << qtext(problem);
            if (report->status == SessionStatus::Intact)
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
    const auto* entry = current();
    if (entry == nullptr) return;
    auto out = entry->path;
    out.replace_extension(".pdf");
    say(tr("Drawing the report…"));
    reports_.make(qtext(entry->path.string()), qtext(out.string()));
}

void SessionsWorkspace::askExport() {
    const auto* entry = current();
    if (entry == nullptr) return;
    FileQuestion question;
    question.title = tr("Export %1 into a new folder").arg(qtext(entry->path.filename().string()));
    question.wants = FileQuestion::Wants::NewFile;
    question.folder = qtext(entry->path.parent_path().string());
    question.name = qtext(entry->path.stem().string()) + "-csv";
    // This one, whatever is selected when the folder is chosen.
    const auto session = entry->path;
    askForFile(*this, question, [this, session](const QString& folder) { exportSession(session, folder); });
}

void SessionsWorkspace::exportTo(const QString& folder) {
    if (const auto* entry = current()) exportSession(entry->path, folder);
}

void SessionsWorkspace::exportSession(const std::filesystem::path& session, const QString& folder) {
    say(tr("Exporting…"));
    work_.start(
        [session, folder](const WorkPort& port) { return exportCsv(session, folder.toStdString(), port); },
        [this, folder](const Result<void>& done) {
            say(done ? tr("Exported to %1").arg(folder) : tr("Not exported: %1").arg(qtext(done.error().message)));
        });
}

void SessionsWorkspace::replay() {
    const auto* entry = current();
    if (entry == nullptr) return;
    auto folder = std::make_unique<QTemporaryDir>();
    const auto target = folder->path() + "/" + qtext(entry->path.stem().string());
    replayed_ = std::move(folder);
    say(tr("Preparing the replay…"));
    work_.start([path = entry->path,
                 target](const WorkPort& port) { return exportRecording(path, target.toStdString(), port); },
                [this, target](const Result<void>& done) {
                    if (!done) return say(tr("Cannot be replayed: %1").arg(qtext(done.error().message)));
                    say({});
                    emit recordingReady(target);
                });
}

void SessionsWorkspace::compare() {
    const auto rows = selected();
    if (rows.size() != 2) return;
    const auto both = std::make_shared<std::array<std::shared_ptr<ReadSession>, 2>>();
    const std::array<std::filesystem::path, 2> paths{entries_[rows[0]].path, entries_[rows[1]].path};
    work_.start(
        [paths, both](const WorkPort&) -> Result<void> {
            for (std::size_t i = 0; i < 2; ++i) {
                auto read = readSession(paths[i]);
                if (!read) return failure(read);
                (*both)[i] = std::make_shared<ReadSession>(std::move(*read));
            }
            return {};
        },
        [this, both](const Result<void>& done) {
            if (!done) return say(qtext(done.error().message));
            openDialog(new CompareWindow((*both)[0], (*both)[1], this));
        });
}

void SessionsWorkspace::showInFolder() {
    if (const auto* entry = current())
        QDesktopServices::openUrl(QUrl::fromLocalFile(qtext(entry->path.parent_path().string())));
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

}  // namespace tacto::gui
