#include "app/gui/sessions/SessionModel.h"

#include <QFileInfo>
#include <QIcon>
#include <QStandardPaths>
#include <QStringList>
#include <algorithm>

#include "app/gui/sessions/SessionWords.h"
#include "app/gui/theme/Icons.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"
#include "app/report/NumberText.h"

namespace tacto::gui {

namespace {

constexpr int kEndingIcon = 16;
constexpr double kIconScale = 2;  // sharp on every screen

}  // namespace

SessionModel::SessionModel(QObject* parent) : QAbstractTableModel(parent) {}

void SessionModel::setEntries(std::vector<SessionEntry> entries, const std::filesystem::path& recording) {
    beginResetModel();
    entries_ = std::move(entries);
    recording_ = recording;
    arrange();
    endResetModel();
}

void SessionModel::replace(SessionEntry entry) {
    const auto at = std::ranges::find(entries_, entry.path, &SessionEntry::path);
    if (at == entries_.end()) return;
    *at = std::move(entry);
    const int row = rowOf(at->path);
    if (row >= 0) emit dataChanged(index(row, 0), index(row, kColumns - 1));
}

void SessionModel::setFilter(const SessionFilter& filter) {
    beginResetModel();
    filter_ = filter;
    arrange();
    endResetModel();
}

void SessionModel::recolour() {
    if (!rows_.empty()) emit dataChanged(index(0, kVerdict), index(int(rows_.size()) - 1, kVerdict));
}

bool SessionModel::passes(const SessionEntry& entry, const QStringList& words) const {
    if (!filter_.ending.isEmpty() && endingOf(entry, entry.path == recording_).word != filter_.ending) return false;
    if (filter_.withinDays && entry.began.date().daysTo(QDate::currentDate()) > *filter_.withinDays) return false;
    return std::ranges::all_of(words, [&](const auto& word) { return entry.searched.contains(word); });
}

void SessionModel::arrange() {
    const auto words = filter_.words.toLower().split(' ', Qt::SkipEmptyParts);
    rows_.clear();
    for (std::size_t i = 0; i < entries_.size(); ++i)
        if (passes(entries_[i], words)) rows_.push_back(i);
    const bool up = order_ == Qt::AscendingOrder;
    const auto by = [&](auto&& key) {
        std::ranges::stable_sort(rows_, [&](std::size_t a, std::size_t b) {
            return up ? key(entries_[a]) < key(entries_[b]) : key(entries_[b]) < key(entries_[a]);
        });
    };
    if (column_ == kBegan)
        by([](const SessionEntry& entry) { return entry.began_ms; });
    else if (column_ == kLength)
        by([](const SessionEntry& entry) { return entry.summary.duration_s; });
    else
        by([this](const SessionEntry& entry) { return text(entry, column_); });
}

int SessionModel::rowOf(const std::filesystem::path& path) const {
    for (std::size_t row = 0; row < rows_.size(); ++row)
        if (entries_[rows_[row]].path == path) return int(row);
    return -1;
}

int SessionModel::rowCount(const QModelIndex& parent) const { return parent.isValid() ? 0 : int(rows_.size()); }
int SessionModel::columnCount(const QModelIndex& parent) const { return parent.isValid() ? 0 : int(kColumns); }

QString SessionModel::text(const SessionEntry& entry, int column) const {
    const auto& labels = entry.summary.labels;
    const bool readable = entry.problem.isEmpty();
    switch (column) {
        case kVerdict:
            return endingOf(entry, entry.path == recording_).word;
        case kBegan:
            return beganText(entry.began);
        case kProcedure:
            return readable ? procedureText(entry.summary.protocol) : qtext(entry.path.filename().string());
        case kSample:
            return qtext(labels.sample);
        case kOperator:
            return qtext(labels.operatorName);
        case kLength:
            return readable ? durationText(entry.summary.duration_s) : QString("–");
        default: {
            QStringList said;
            if (!labels.note.empty()) said << qtext(labels.note);
            for (const auto& tag : labels.tags) said << "#" + qtext(tag);
            return said.join(' ');
        }
    }
}

QString SessionModel::about(const SessionEntry& entry) const {
    if (!entry.problem.isEmpty()) return entry.problem;
    QStringList lines{qtext(entry.path.string()), tr("%1, %2 MB%3")
                                                      .arg(entry.began.toString("yyyy-MM-dd HH:mm:ss"))
                                                      .arg(double(entry.bytes) / 1e6, 0, 'f', 1)
                                                      .arg(entry.summary.simulated ? tr(", simulated") : QString())};
    QStringList devices;
    for (const auto& device : entry.summary.devices) devices << qtext(device);
    if (!devices.isEmpty()) lines << devices.join(", ");
    if (const auto note = text(entry, kNote); !note.isEmpty()) lines << note;
    return lines.join('\n');
}

QVariant SessionModel::data(const QModelIndex& index, int role) const {
    if (!index.isValid() || index.row() >= int(rows_.size())) return {};
    const auto& shown = entry(index.row());
    switch (role) {
        case Qt::DisplayRole:
            return text(shown, index.column());
        case Qt::ToolTipRole:
            // A cell may be too narrow for its text.
            return QString(text(shown, index.column()) + "\n" + about(shown)).trimmed();
        case Qt::TextAlignmentRole:
            return index.column() == kLength ? int(Qt::AlignRight | Qt::AlignVCenter)
                                             : int(Qt::AlignLeft | Qt::AlignVCenter);
        case Qt::DecorationRole: {
            if (index.column() != kVerdict) return {};
            const auto ending = endingOf(shown, shown.path == recording_);
            return QIcon(iconPixmap(ending.icon, ending.colour, scaledPx(kEndingIcon), kIconScale));
        }
        case Qt::ForegroundRole:
            return index.column() == kVerdict ? QVariant(endingOf(shown, shown.path == recording_).colour) : QVariant();
        default:
            return {};
    }
}

QVariant SessionModel::headerData(int section, Qt::Orientation orientation, int role) const {
    if (orientation != Qt::Horizontal) return {};
    if (role == Qt::TextAlignmentRole)
        return int((section == kLength ? Qt::AlignRight : Qt::AlignLeft) | Qt::AlignVCenter);
    if (role != Qt::DisplayRole) return {};
    const QString titles[kColumns] = {tr("Verdict"), tr("Began"),  tr("Procedure"), tr("Sample"),
                                      tr("By"),      tr("Length"), tr("Note")};
    return titles[section];
}

void SessionModel::sort(int column, Qt::SortOrder order) {
    if (column < 0) return;
    emit layoutAboutToBeChanged();
    std::vector<std::size_t> before;
    const auto kept = persistentIndexList();
    for (const auto& index : kept) before.push_back(rows_[std::size_t(index.row())]);
    column_ = column;
    order_ = order;
    arrange();
    for (int i = 0; i < int(kept.size()); ++i) {
        const auto at = std::ranges::find(rows_, before[std::size_t(i)]);
        changePersistentIndex(kept[i], index(int(at - rows_.begin()), kept[i].column()));
    }
    emit layoutChanged();
}

namespace fs = std::filesystem;

SessionEntry::SessionEntry(ListedSession listed)
    : path(std::move(listed.path)),
      summary(std::move(listed.summary)),
      began(QDateTime::fromString(qtext(summary.wallStart), Qt::ISODate).toLocalTime()),
      bytes(qint64(listed.bytes)),
      elsewhere(!summary.closed && openElsewhere(path)),
      problem(qtext(listed.problem)) {
    if (!began.isValid()) began = QFileInfo(qtext(path.string())).lastModified();
    began_ms = began.toMSecsSinceEpoch();
    const auto& labels = summary.labels;
    QStringList all{qtext(path.string()),
                    procedureText(summary.protocol),
                    qtext(summary.protocol),
                    qtext(summary.verdict),
                    qtext(labels.operatorName),
                    qtext(labels.sample),
                    qtext(labels.note),
                    problem,
                    began.toString(Qt::ISODate),
                    beganText(began),
                    summary.simulated ? "simulated" : "",
                    summary.faulted ? "fault" : ""};
    for (const auto& tag : labels.tags) all << qtext(tag);
    for (const auto& device : summary.devices) all << qtext(device);
    searched = all.join('\n').toLower();
}

SessionIndex userSessionIndex() {
    const auto caches = QStandardPaths::writableLocation(QStandardPaths::GenericCacheLocation);
    return SessionIndex(fs::path(caches.toStdString()) / "tactoscope" / "sessions.index");
}

std::vector<fs::path> sessionFiles(const fs::path& folder) {
    std::vector<fs::path> files;
    std::error_code error;
    const auto look = [&](const fs::path& in, auto&& self, int depth) -> void {
        for (const auto& item : fs::directory_iterator(in, error)) {
            std::error_code gone;
            if (item.path().extension() == ".tacto" && item.is_regular_file(gone)) files.push_back(item.path());
            if (depth > 0 && item.is_directory(gone)) self(item.path(), self, depth - 1);
        }
    };
    look(folder, look, 1);
    std::sort(files.begin(), files.end(), [](const auto& a, const auto& b) { return a.filename() > b.filename(); });
    return files;
}

}  // namespace tacto::gui

#include "moc_SessionModel.cpp"
