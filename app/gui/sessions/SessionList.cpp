#include "app/gui/sessions/SessionList.h"

#include <QHeaderView>
#include <QPainter>
#include <QScrollBar>
#include <QShortcut>
#include <QStyledItemDelegate>
#include <algorithm>

#include "app/gui/theme/Building.h"
#include "app/gui/theme/Icons.h"
#include "app/gui/theme/Labels.h"
#include "app/gui/theme/Text.h"
#include "app/run/RunFiles.h"

namespace tacto::gui {

namespace {

constexpr int kRow = 32;
constexpr int kMinRows = 4;  // visible rows, including the header
constexpr int kListIcon = 16;
constexpr int kSeenAfter_ms = 150;
constexpr int kMeasuredRows = 60;  // number of rows measured to choose the column widths
constexpr int kRoomyChars = 88;    // width from which all columns are shown
constexpr int kWordyChars = 84;    // width from which the search field says what it searches
constexpr int kGap = 8, kSide = 16;
constexpr int kEdge = 2;  // width of the frame lines around a table that is not laid out yet
constexpr int kChosenBar = 4;
constexpr int kLead = 9;  // left edge of search and titles, including the shape's edges

/// Draws a bar at the left edge of the chosen row.
class VerdictDelegate final : public QStyledItemDelegate {
public:
    using QStyledItemDelegate::QStyledItemDelegate;
    void paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const override {
        const bool chosen = (option.state & QStyle::State_Selected) != 0;
        const QRect bar(option.rect.left(), option.rect.top(), kChosenBar, option.rect.height());
        auto within = option;
        within.rect.setLeft(option.rect.left() + kLead);
        QStyledItemDelegate::paint(painter, within, index);
        QRect lead(option.rect.topLeft(), QSize(kLead, option.rect.height()));
        if (chosen) painter->fillRect(lead, colours().selection);
        lead.setTop(lead.bottom());
        painter->fillRect(lead, colours().grid);  // the line between rows
        if (chosen) painter->fillRect(bar, colours().primary);
    }
    [[nodiscard]] QSize sizeHint(const QStyleOptionViewItem& option, const QModelIndex& index) const override {
        return QStyledItemDelegate::sizeHint(option, index) + QSize(kLead, 0);
    }
};

}  // namespace

SessionList::SessionList(QWidget* parent)
    : QWidget(parent),
      index_(userSessionIndex()),
      model_(new SessionModel(this)),
      empty_(makeLabel({}, {.name = "sessionsEmpty", .wraps = true}, this)) {
    auto* column = columnIn(*this, 0);
    column->addWidget(buildSearch());
    buildTable();
    column->addWidget(table_, 1);
    empty_->setAlignment(Qt::AlignCenter);
    empty_->setMargin(kGap);
    column->addWidget(empty_, 1);
    seen_.setSingleShot(true);
    seen_.setInterval(kSeenAfter_ms);
    connect(&seen_, &QTimer::timeout, this, &SessionList::confirmSeen);
    connect(table_->verticalScrollBar(), &QScrollBar::valueChanged, &seen_, qOverload<>(&QTimer::start));
    say();
    onEvent(*this, QEvent::Resize, [this] {
        const bool wordy = width() >= fontMetrics().averageCharWidth() * kWordyChars;
        search_->setPlaceholderText(wordy ? tr("Search names, notes, tags") : tr("Search"));
        count_->setVisible(wordy);
        const bool roomy = width() >= fontMetrics().averageCharWidth() * kRoomyChars;
        for (const int each : {SessionModel::kOperator, SessionModel::kLength}) table_->setColumnHidden(each, !roomy);
        fitColumns();  // a hidden column has no contents to fit
        seen_.start();
    });
}

QWidget* SessionList::buildSearch() {
    auto* holder = new QWidget(this);
    auto* row = rowIn(*holder, kGap, {kSide, kGap, kSide, kGap});
    search_ = new QLineEdit(holder);
    search_->addAction(icon("search"), QLineEdit::LeadingPosition)->setToolTip(tr("Search"));
    search_->setClearButtonEnabled(true);
    search_->setAccessibleName(tr("Search"));
    search_->setToolTip(
        tr("Shows only sessions that contain every word: procedure, note, operator, sample, tags, "
           "verdict, devices, date or file name (Ctrl+F)."));
    auto* find = new QShortcut(QKeySequence::Find, this, nullptr, nullptr, Qt::WidgetWithChildrenShortcut);
    connect(find, &QShortcut::activated, search_, [this] { search_->setFocus(); });
    ending_ = new QComboBox(holder);
    ending_->setAccessibleName(tr("Verdict"));
    ending_->setToolTip(tr("Shows only sessions with this verdict."));
    ending_->addItem(tr("Any verdict"), QString());
    for (const auto& word : {tr("pass"), tr("fail"), tr("indeterminate"), tr("stopped"), tr("fault"), tr("no verdict")})
        ending_->addItem(word, word);
    age_ = new QComboBox(holder);
    age_->setAccessibleName(tr("Date"));
    age_->setToolTip(tr("Shows only sessions that began within this time."));
    age_->addItem(tr("Any date"));
    age_->addItem(tr("Today"), 0);
    age_->addItem(tr("7 days"), 6);
    age_->addItem(tr("30 days"), 29);
    count_ = makeLabel({}, {.name = "sessionsCount", .tone = Tone::Quiet, .size = TextSize::Small}, holder);
    row->addWidget(search_, 1);
    addAll(*row, {ending_, age_, count_});
    for (auto* box : {ending_, age_}) {
        box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
        box->setMinimumContentsLength(int(box->currentText().size()));
    }
    connect(search_, &QLineEdit::textChanged, this, &SessionList::filter);
    connect(ending_, &QComboBox::currentIndexChanged, this, &SessionList::filter);
    connect(age_, &QComboBox::currentIndexChanged, this, &SessionList::filter);
    return holder;
}

void SessionList::buildTable() {
    table_ = new QTableView(this);
    nameWidget(*table_, "sessionsTable", tr("Sessions"));
    table_->setModel(model_);
    table_->setItemDelegateForColumn(SessionModel::kVerdict, new VerdictDelegate(table_));
    setTextSize(*table_->horizontalHeader(), TextSize::Small);
    table_->setWordWrap(false);
    table_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);  // the last column takes the rest and elides its text
    makeReadOnly(*table_);
    table_->setSelectionBehavior(QAbstractItemView::SelectRows);
    table_->setSelectionMode(QAbstractItemView::ExtendedSelection);
    table_->horizontalHeader()->setResizeContentsPrecision(kMeasuredRows);
    table_->horizontalHeader()->setStretchLastSection(true);
    table_->horizontalHeader()->setHighlightSections(false);
    table_->setSortingEnabled(true);
    table_->sortByColumn(SessionModel::kBegan, Qt::DescendingOrder);
    table_->setToolTip(tr("Every session of the sessions folder, newest first. Drop other *.tacto files here."));
    connect(table_->selectionModel(), &QItemSelectionModel::selectionChanged, this, [this] {
        if (!arranging_) emit selectionChanged();
    });
    const auto grow = [this] {
        table_->verticalHeader()->setDefaultSectionSize(scaledPx(kRow));
        table_->setIconSize({scaledPx(kListIcon), scaledPx(kListIcon)});
        table_->setMinimumHeight(scaledPx(kMinRows * kRow));
    };
    grow();
    onLookChange(*this, [this, grow] {
        grow();
        model_->recolour();
    });
    // The widths may change once the header's text size is set.
    connect(
        table_->horizontalScrollBar(), &QScrollBar::rangeChanged, this,
        [this] {
            const bool scrolls = table_->horizontalScrollBar()->maximum() > 0;
            if (scrolls && !table_->isColumnHidden(SessionModel::kSample)) fitColumns();
        },
        Qt::QueuedConnection);
    afterLookChange(*this, [this] { fitColumns(); });  // called once the header has its text size
}

void SessionList::rescan(const std::filesystem::path& recording) {
    recording_ = recording;
    using Entries = std::vector<SessionEntry>;
    scan_.take(
        [index = index_, others = others_](const WorkPort& port) -> Result<Entries> {
            auto files = sessionFiles(userSessionsFolder());
            for (const auto& other : others)
                if (std::ranges::find(files, other) == files.end()) files.push_back(other);
            const int total = int(files.size());
            auto listed = index.list(files, [&](std::size_t done) {
                port.progress(int(done), total);
                return !port.stopped();
            });
            if (port.stopped()) return fail(ErrorCode::Stopped, "cancelled");
            Entries found;
            found.reserve(listed.size());
            for (auto& session : listed) found.emplace_back(std::move(session));
            return found;
        },
        [this](Result<Entries> found) {
            if (found) take(std::move(*found));
        });
}

void SessionList::take(std::vector<SessionEntry> entries) {
    const bool asked = !wanted_.empty();
    const bool same =
        std::ranges::equal(entries, model_->entries(), [](const auto& a, const auto& b) { return a.sameAs(b); });
    if (same && !asked && shownRecording_ == recording_) return say();
    shownRecording_ = recording_;
    confirmed_.clear();
    const auto before = chosenNow();
    auto chosen = chosenPaths();
    if (!wanted_.empty()) chosen = {wanted_};
    arranging_ = true;
    model_->setEntries(std::move(entries), recording_);
    if (asked && model_->rowOf(wanted_) < 0) {  // a search must not hide the session asked for
        for (auto* box : {ending_, age_}) box->setCurrentIndex(0);
        search_->clear();
    }
    arranging_ = true;  // filter() sets it to false
    choose(chosen);
    arranging_ = false;
    wanted_.clear();
    fitColumns();
    say();
    if (asked || chosenNow() != before) emit selectionChanged();
    seen_.start();
}

void SessionList::fitColumns() {
    for (const int each : {SessionModel::kSample, SessionModel::kNote}) table_->setColumnHidden(each, false);
    for (int each = 0; each < SessionModel::kNote; ++each) table_->resizeColumnToContents(each);
    auto* header = table_->horizontalHeader();
    const int note = std::max(header->minimumSectionSize(), header->sectionSizeHint(SessionModel::kNote));
    header->resizeSection(SessionModel::kNote, note);  // Qt stretches this column but never makes it narrower
    const auto least = [&] { return header->length() - header->sectionSize(SessionModel::kNote) + note; };
    // The table may get its own size later.
    const int bar = table_->verticalScrollBar()->sizeHint().width();
    const bool placed = table_->isVisible() && table_->width() == width();
    const int room = !placed ? width() - bar - 2 * table_->frameWidth() - kEdge
                             : table_->viewport()->width() - (table_->verticalScrollBar()->isVisible() ? 0 : bar);
    table_->setColumnHidden(SessionModel::kSample, least() > room);
    table_->setColumnHidden(SessionModel::kNote, least() > room);
    // The last visible column becomes narrower, since Qt stretches it but never makes it narrower.
    if (const int over = header->length() - room; over > 0 && table_->isColumnHidden(SessionModel::kNote))
        table_->setColumnWidth(SessionModel::kProcedure, header->sectionSize(SessionModel::kProcedure) - over);
}

/// Returns everything on which the display of the chosen sessions depends, except the labels, which are edited there.
std::vector<std::pair<std::filesystem::path, SessionSummary>> SessionList::chosenNow() const {
    std::vector<std::pair<std::filesystem::path, SessionSummary>> now;
    for (const auto* entry : selected()) {
        now.emplace_back(entry->path, entry->summary);
        now.back().second.labels = {};
    }
    return now;
}

void SessionList::choose(const std::vector<std::filesystem::path>& paths) {
    table_->clearSelection();
    for (const auto& path : paths) {
        const int row = model_->rowOf(path);
        if (row < 0) continue;
        const auto at = model_->index(row, 0);
        table_->selectionModel()->setCurrentIndex(at, QItemSelectionModel::Select | QItemSelectionModel::Rows);
        table_->scrollTo(at);
    }
}

void SessionList::add(const std::filesystem::path& file) {
    const auto listed = std::ranges::find(model_->entries(), file, &SessionEntry::path) != model_->entries().end();
    if (!listed && file.parent_path() != userSessionsFolder()) others_.insert(file);
    wanted_ = file;
}

void SessionList::confirm(const std::filesystem::path& file) {
    confirmed_.erase(file);
    confirmSeen();
}

/// Reads the visible sessions themselves, since the index may be out of date.
void SessionList::confirmSeen() {
    const int first = table_->rowAt(0);
    if (first < 0) return;
    const int last = table_->rowAt(table_->viewport()->height() - 1);
    std::vector<std::filesystem::path> paths;
    for (int row = first; row <= (last < 0 ? model_->rowCount() - 1 : last); ++row) {
        const auto& path = model_->entry(row).path;
        if (path != recording_ && !confirmed_.contains(path)) paths.push_back(path);
    }
    if (paths.empty()) return;
    using Read = std::vector<ListedSession>;
    confirm_.take(
        [paths, index = index_](const WorkPort& port) -> Result<Read> {
            Read read;
            for (const auto& path : paths) {
                if (port.stopped()) return fail(ErrorCode::Stopped, "cancelled");
                read.push_back(index.read(path));
            }
            return read;
        },
        [this](Result<Read> read) {
            if (!read) return;
            for (auto& session : *read) {
                confirmed_.insert(session.path);
                model_->replace(SessionEntry(std::move(session)));
            }
        });
}

void SessionList::filter() {
    SessionFilter wanted{search_->text(), ending_->currentData().toString(), {}};
    if (age_->currentData().isValid()) wanted.withinDays = age_->currentData().toInt();
    const auto chosen = chosenPaths();
    arranging_ = true;
    model_->setFilter(wanted);
    choose(chosen);  // a session that is not shown cannot be acted on
    arranging_ = false;
    say();
    if (chosenPaths() != chosen) emit selectionChanged();
    seen_.start();
}

void SessionList::say() {
    const int shown = model_->rowCount();
    const int all = int(model_->entries().size());
    const auto many = all == 1 ? tr("1 session") : tr("%1 sessions").arg(all);
    count_->setText(shown == all ? many : tr("%1 of %2").arg(shown).arg(many));
    table_->setVisible(shown > 0);
    empty_->setVisible(shown == 0);
    if (all == 0)
        empty_->setText(
            tr("No session yet. Every open bench and every protocol run is recorded and appears here: open "
               "the simulated bench (Ctrl+B) or run Separability. Pilot sessions are kept in their study: see Pilot."));
    else if (search_->text().trimmed().isEmpty())
        empty_->setText(tr("No session has this verdict and date."));
    else
        empty_->setText(tr("No session contains “%1”. The search covers procedure, note, operator, sample, tags, "
                           "verdict, devices, date and file name.")
                            .arg(search_->text().trimmed()));
}

std::vector<std::filesystem::path> SessionList::chosenPaths() const {
    std::vector<std::filesystem::path> paths;
    for (const auto* entry : selected()) paths.push_back(entry->path);
    return paths;
}

std::vector<const SessionEntry*> SessionList::selected() const {
    auto rows = table_->selectionModel()->selectedRows();
    std::ranges::sort(rows, {}, &QModelIndex::row);
    std::vector<const SessionEntry*> found;
    for (const auto& index : rows) found.push_back(&model_->entry(index.row()));
    return found;
}

const SessionEntry* SessionList::current() const {
    const auto all = selected();
    return all.size() == 1 ? all[0] : nullptr;
}

}  // namespace tacto::gui

#include "moc_SessionList.cpp"
