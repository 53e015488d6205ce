#include "core/session/Schema.h"

namespace tacto {

namespace {

constexpr const char* kTables = R"sql(
CREATE TABLE entries(
    seq INTEGER PRIMARY KEY,
    kind TEXT NOT NULL,
    t_ns INTEGER NOT NULL,
    name TEXT NOT NULL,
    body TEXT NOT NULL,
    digest BLOB,
    prev BLOB NOT NULL,
    hash BLOB NOT NULL) STRICT;
CREATE TABLE chunks(
    seq INTEGER PRIMARY KEY,
    stream INTEGER NOT NULL,
    idx INTEGER NOT NULL,
    stamps BLOB,
    data BLOB NOT NULL) STRICT;
CREATE UNIQUE INDEX chunks_by_stream ON chunks(stream, idx);
CREATE TABLE captures(
    seq INTEGER PRIMARY KEY,
    data BLOB NOT NULL) STRICT;

CREATE TRIGGER entries_keep BEFORE UPDATE ON entries BEGIN SELECT RAISE(ABORT, 'a session is append-only'); END;
CREATE TRIGGER entries_stay BEFORE DELETE ON entries BEGIN SELECT RAISE(ABORT, 'a session is append-only'); END;
CREATE TRIGGER chunks_keep BEFORE UPDATE ON chunks BEGIN SELECT RAISE(ABORT, 'a session is append-only'); END;
CREATE TRIGGER chunks_stay BEFORE DELETE ON chunks BEGIN SELECT RAISE(ABORT, 'a session is append-only'); END;
CREATE TRIGGER captures_keep BEFORE UPDATE ON captures BEGIN SELECT RAISE(ABORT, 'a session is append-only'); END;
CREATE TRIGGER captures_stay BEFORE DELETE ON captures BEGIN SELECT RAISE(ABORT, 'a session is append-only'); END;

CREATE VIEW events AS SELECT seq, t_ns / 1e9 AS t_s, name AS event, body AS details FROM entries WHERE kind = 'event';
CREATE VIEW commands AS SELECT seq, t_ns / 1e9 AS t_s, name AS command, body AS details FROM entries
    WHERE kind = 'command';
CREATE VIEW trials AS SELECT seq, t_ns / 1e9 AS t_s, json_extract(body, '$.number') AS number, name AS condition,
    json_extract(body, '$.measured') AS measured FROM entries WHERE kind = 'trial';
CREATE VIEW verdicts AS SELECT seq, t_ns / 1e9 AS t_s, name AS subject, json_extract(body, '$.verdict') AS verdict,
    json_extract(body, '$.reasons') AS reasons, json_extract(body, '$.results') AS results FROM entries
    WHERE kind = 'verdict';
CREATE VIEW measurements AS SELECT seq, t_ns / 1e9 AS t_s, name AS quantity, body AS 'values' FROM entries
    WHERE kind = 'measurement';
CREATE VIEW streams AS SELECT row_number() OVER (ORDER BY seq) AS stream, name, body AS description FROM entries
    WHERE kind = 'stream';
CREATE VIEW log AS SELECT seq, t_ns / 1e9 AS t_s, name AS level, json_extract(body, '$.text') AS text FROM entries
    WHERE kind = 'log';
)sql";

}  // namespace

Result<void> createSchema(Database& database, int version) {
    // The page size must be set before the first write. Compared with 4 kB, pages of 16 kB would halve the cost of
    // large blobs, but make a commit of one small row 0.05 ms slower.
    return database.execute(
        fmt::format("PRAGMA page_size=4096; PRAGMA journal_mode=WAL;"
                    "BEGIN; PRAGMA application_id={}; PRAGMA user_version={}; {} COMMIT;",
                    kApplicationId, version, kTables));
}

}  // namespace tacto
