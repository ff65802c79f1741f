//! The demands of a rule's check: each of its comparisons, with the numbers of its parameters.
//!
//! Only comparisons of a fact, or of a function of weak places, with one parameter or number are read. An edit
//! is checked by the whole expression, so that an unread demand costs a proposal and never makes a wrong one.

use endline_gear::Rule;

use super::super::facts::FACTS;

/// A number of a demand.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Limit {
    /// In SI units.
    pub si: f64,
    /// As its pack has it, such as `60 ft`.
    pub text: String,
}

/// One comparison of a check.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Demand {
    /// A fact compared with a limit; the limit is not read where it is made of several numbers.
    Fact { name: &'static str, at_most: bool, limit: Option<Limit> },
    /// A weak place near a share of the endline from the buoy.
    WeakAt { share: f64, strength_n: f64 },
    /// Weak places no further apart than this in the top share of the endline.
    WeakEvery { spacing: Limit, top: f64, strength_n: f64 },
    /// The top share of the endline is weak throughout.
    WeakOver { top: f64, strength_n: f64 },
    /// No weak place nearer to the buoy than this.
    WeakBelow { clear: Limit },
}

/// Reads the demands of a rule's check, in its order.
pub(super) fn of(rule: &Rule) -> Vec<Demand> {
    let tokens = tokens(&rule.check.value);
    let reader = Reader { rule, tokens: &tokens };
    (0..tokens.len()).filter_map(|at| reader.demand(at)).collect()
}

struct Reader<'a> {
    rule: &'a Rule,
    tokens: &'a [String],
}

impl Reader<'_> {
    /// The demand that begins with a token, if one does.
    fn demand(&self, at: usize) -> Option<Demand> {
        match self.tokens[at].as_str() {
            "place_from" => {
                let (arguments, _) = self.arguments(at)?;
                let [places, share] = arguments.as_slice() else { return None };
                let (_, strength_n) = self.weak_places(places.0)?;
                Some(Demand::WeakAt { share: self.number(*share)?.si, strength_n })
            }
            "longest_gap" => {
                let (places, limit) = self.of_places(at)?;
                let (top, strength_n) = self.weak_places(places)?;
                Some(Demand::WeakEvery { spacing: limit?, top, strength_n })
            }
            "share_of" => {
                let (top, strength_n) = self.weak_places(self.of_places(at)?.0)?;
                Some(Demand::WeakOver { top, strength_n })
            }
            "first_place" => Some(Demand::WeakBelow { clear: self.of_places(at)?.1? }),
            word => {
                let fact = FACTS.iter().find(|fact| fact.name == word)?;
                let sign = self.tokens.get(at + 1).filter(|sign| is_sign(sign))?;
                let limit = self.right(at + 2);
                Some(Demand::Fact { name: fact.name, at_most: at_most(sign, &limit), limit })
            }
        }
    }

    /// Where the places begin that a function of one value takes, and the limit right of the sign that follows.
    fn of_places(&self, at: usize) -> Option<(usize, Option<Limit>)> {
        let (arguments, end) = self.arguments(at)?;
        let sign = self.tokens.get(end + 1).filter(|sign| is_sign(sign));
        Some((arguments.first()?.0, sign.and_then(|_| self.right(end + 2))))
    }

    /// Share of the endline and strength of `weak_places(…)`.
    fn weak_places(&self, at: usize) -> Option<(f64, f64)> {
        if self.tokens[at] != "weak_places" {
            return None;
        }
        let (arguments, _) = self.arguments(at)?;
        let [line, strength] = arguments.as_slice() else { return None };
        let top = if self.tokens[line.0] == "upper_part" {
            let (parts, _) = self.arguments(line.0)?;
            self.number(*parts.get(1)?)?.si
        } else {
            1.0
        };
        Some((top, self.number(*strength)?.si))
    }

    /// From and to of each argument of a function, and the index of its closing bracket.
    fn arguments(&self, function: usize) -> Option<(Vec<(usize, usize)>, usize)> {
        let (mut open, mut start, mut found) = (0, function + 2, Vec::new());
        for at in function + 1..self.tokens.len() {
            match self.tokens[at].as_str() {
                "(" => open += 1,
                ")" if open == 1 => {
                    found.push((start, at));
                    return Some((found, at));
                }
                ")" => open -= 1,
                "," if open == 1 => {
                    found.push((start, at));
                    start = at + 1;
                }
                _ => {}
            }
        }
        None
    }

    /// A limit right of a sign: one parameter or number alone.
    fn right(&self, at: usize) -> Option<Limit> {
        let continues = |next: &String| ["+", "-", "*", "/"].contains(&next.as_str());
        if self.tokens.get(at + 1).is_some_and(continues) {
            return None;
        }
        self.number((at, at + 1))
    }

    fn number(&self, (from, to): (usize, usize)) -> Option<Limit> {
        let [word] = self.tokens.get(from..to)? else { return None };
        let own = self.rule.parameters.iter().find(|parameter| parameter.key == *word);
        own.map(|own| Limit { si: own.value, text: own.text.clone() })
            .or_else(|| Some(Limit { si: word.parse().ok()?, text: word.clone() }))
    }
}

/// Whether a fact must stay below its limit: of an equality, where the limit is zero.
fn at_most(sign: &str, limit: &Option<Limit>) -> bool {
    sign.starts_with('<') || (sign == "==" && limit.as_ref().is_some_and(|one| one.si <= 0.0))
}

fn is_sign(token: &str) -> bool {
    ["<", "<=", ">", ">=", "=="].contains(&token)
}

/// Names, numbers, signs and brackets.
fn tokens(text: &str) -> Vec<String> {
    let mut tokens: Vec<String> = Vec::new();
    let mut joins = false;
    for letter in text.chars() {
        let is_word = letter.is_ascii_alphanumeric() || letter == '_' || letter == '.';
        let is_sign = "<>=!&|".contains(letter);
        let same = |last: &String| {
            let first = last.chars().next().unwrap_or(' ');
            if is_word {
                first.is_ascii_alphanumeric() || first == '_'
            } else {
                "<>=!&|".contains(first)
            }
        };
        match tokens.last_mut().filter(|last| joins && (is_word || is_sign) && same(last)) {
            Some(last) => last.push(letter),
            None if !letter.is_whitespace() => tokens.push(letter.to_string()),
            None => {}
        }
        joins = !letter.is_whitespace();
    }
    tokens
}
