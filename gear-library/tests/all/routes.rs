//! Routes and observed shares of shipped studies, counted again from the table of accounts that they name as their source.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail the test")]

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use endline_gear::Study;

/// The table of accounts.
const TABLE: &str = "cases/tables/noaa-entanglement-cases.csv";

/// A row of the table by its columns.
type Account = BTreeMap<String, String>;

fn read(file: &str) -> String {
    fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(file)).unwrap()
}

fn study(name: &str) -> Study {
    Study::read(name, &read(&format!("studies/{name}"))).unwrap()
}

/// Whether an account says yes to a column.
fn is(account: &Account, column: &str) -> bool {
    account[column] == "1"
}

/// Mouth or head, flipper, tail.
fn places(account: &Account) -> [bool; 3] {
    let says = |column| is(account, column);
    [says("mouth") || says("head"), says("flipper"), says("tail")]
}

/// Length that trails, if the account states it [m].
fn length_m(account: &Account) -> Option<f64> {
    account["trailing_m"].parse().ok()
}

/// Accounts of whales of a species in the Atlantic that were seen with gear on them.
fn accounts(species: &str) -> Vec<Account> {
    let table = read(TABLE);
    let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_reader(table.as_bytes());
    let all = reader.deserialize::<Account>().map(Result::unwrap);
    all.filter(|account| {
        account["species"] == species && account["ocean"] == "ATL" && is(account, "gear_present")
    })
    .collect()
}

#[test]
fn the_routes_of_a_study_are_those_of_its_source() {
    let routes = study("weak-links.toml").routes.unwrap();
    assert!(routes.source.contains(TABLE));
    let stated = [routes.mouth, routes.flipper, routes.tail, routes.several];
    // Mouth or head, flipper or body, tail, several.
    let mut counts = [0; 4];
    for account in accounts("right whale") {
        let [head, flipper, tail] = places(&account);
        match [head, flipper || is(&account, "body"), tail] {
            [false, false, false] => {}
            [true, false, false] => counts[0] += 1,
            [false, true, false] => counts[1] += 1,
            [false, false, true] => counts[2] += 1,
            _ => counts[3] += 1,
        }
    }
    assert_eq!(stated, counts);
}

/// Wilson's score interval of 95 % (Wilson 1927): `(p + z²/2n ± z √(p (1-p)/n + z²/4n²)) / (1 + z²/n)`.
fn wilson(hits: usize, of: usize) -> [f64; 2] {
    let (z, n) = (1.959_964, of as f64);
    let (p, below) = (hits as f64 / n, 1.0 + z * z / n);
    let middle = p + z * z / (2.0 * n);
    let arm = z * (p * (1.0 - p) / n + z * z / (4.0 * n * n)).sqrt();
    [(middle - arm) / below, (middle + arm) / below]
}

/// Accounts that an event is asked of, and those among them that report it in the narrow and in the wide reading.
fn counted(event: &str, accounts: &[Account]) -> (usize, [usize; 2]) {
    let among = |of: &dyn Fn(&Account) -> bool, is_so: &dyn Fn(&Account) -> bool| {
        let asked: Vec<&Account> = accounts.iter().filter(|account| of(account)).collect();
        let hits = asked.iter().filter(|account| is_so(account)).count();
        (asked.len(), [hits, hits])
    };
    let names_a_place = |account: &Account| places(account).contains(&true) || is(account, "body");
    let at = |place: usize| among(&names_a_place, &move |account| places(account)[place]);
    let says = |column: &'static str| among(&|_| true, &move |account| is(account, column));
    match event {
        "on_head" => at(0),
        "on_flipper" => at(1),
        "on_tail" => at(2),
        "on_two_places" => among(&names_a_place, &|account| {
            places(account).iter().filter(|place| **place).count() >= 2
        }),
        "anchored" => says("anchored"),
        "traps_attached" => {
            let (all, [narrow, _]) = says("trap");
            (all, [narrow, says("trap_mentioned").1[1]])
        }
        "buoys_attached" => says("buoy"),
        "trailing" => says("trailing"),
        "trailing_10m" => among(&|account| length_m(account).is_some(), &|account| {
            length_m(account).is_some_and(|length_m| length_m > 10.0)
        }),
        other => panic!("`{other}` is not counted in the table"),
    }
}

#[test]
fn observed_shares_and_their_intervals_are_those_of_the_accounts() {
    for (file, species, option) in
        [("weak-links.toml", "right whale", None), ("species.toml", "humpback", Some("humpback"))]
    {
        let (study, accounts) = (study(file), accounts(species));
        let observations = study.observations.iter().filter(|seen| seen.source.contains(TABLE));
        let mut events = Vec::new();
        for seen in observations {
            let (all, [narrow, wide]) = counted(&seen.of.name(), &accounts);
            let interval = [wilson(narrow, all)[0], wilson(wide, all)[1]];
            let id = &seen.id.value;
            // Shares are stated to the nearest hundredth.
            let is_near = |(stated, own): (&f64, &f64)| (stated - own).abs() <= 0.005;
            assert!(
                seen.observed.iter().zip(&interval).all(is_near),
                "{file}, {id}: {:?}, not {interval:?} of {narrow} to {wide} of {all}",
                seen.observed
            );
            let count =
                if narrow == wide { wide.to_string() } else { format!("{narrow} to {wide}") };
            assert!(
                seen.says.contains(&format!("{count} of {all}")),
                "{file}, {id}: {}",
                seen.says
            );
            assert!(seen.says.starts_with(species), "{file}, {id}: {}", seen.says);
            assert_eq!(seen.option.as_deref(), option, "{file}, {id}");
            events.push(seen.of.name());
        }
        assert_eq!(events.len(), 9, "{file}: {events:?}");
    }
}
