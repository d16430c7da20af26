# The first place where a document breaks its schema, as "/pointer: what was expected"; nothing where it keeps it.
# Knows what the project's own schemas use: type, enum, const, required, properties, items, the bounds of numbers and lists,
# pattern, oneOf, and references within a schema.
def broken($schemas; $schema; $at):
  def types: if type == "array" then . else [.] end;
  def of_type($value): any(types[];
    . == ($value | type) or (. == "integer" and ($value | type == "number" and . == floor)));
  def plain: (keys_unsorted - ["type", "description"]) == [];
  . as $value
  | if $schema["$ref"] then
      broken($schemas; $schemas | getpath($schema["$ref"] | ltrimstr("#/") | split("/")); $at)
    elif $schema.type and ($schema.type | of_type($value) | not) then
      "\($at): expected \($schema.type | types | join(" or "))"
    elif ($schema | has("const")) and $value != $schema.const then "\($at): expected \($schema.const)"
    elif $schema.enum and all($schema.enum[]; . != $value) then "\($at): expected one of \($schema.enum | map(tostring) | join(", "))"
    elif $schema.oneOf and all($schema.oneOf[]; [. as $one | $value | first(broken($schemas; $one; $at))] != []) then
      "\($at): expected another form (see the schema)"
    else
      (if type == "number" then
         if $schema.minimum and . < $schema.minimum then "\($at): expected at least \($schema.minimum)"
         elif $schema.exclusiveMinimum and . <= $schema.exclusiveMinimum then "\($at): expected more than \($schema.exclusiveMinimum)"
         elif $schema.maximum and . > $schema.maximum then "\($at): expected at most \($schema.maximum)"
         else empty end
       elif type == "string" then
         if $schema.pattern and (test($schema.pattern) | not) then "\($at): expected a text like \($schema.pattern)" else empty end
       elif type == "array" then
         if $schema.minItems and length < $schema.minItems then "\($at): expected at least \($schema.minItems) items"
         elif $schema.maxItems and length > $schema.maxItems then "\($at): expected at most \($schema.maxItems) items"
         elif $schema.items == null then empty
         elif ($schema.items | plain) and $schema.items.type and all(.[]; . as $item | $schema.items.type | of_type($item)) then empty
         else range(length) as $i | $value[$i] | broken($schemas; $schema.items; "\($at)/\($i)") end
       elif type == "object" then
         ($schema.required // [] | map(select(. as $name | $value | has($name) | not)) | .[] | "\($at)/\(.): missing"),
         ($schema.properties // {} | keys_unsorted[] | . as $name | select($value | has($name))
          | $value[$name] | broken($schemas; $schema.properties[$name]; "\($at)/\($name)"))
       else empty end)
    end;
first(broken($schema[0]; $schema[0]; ""))
