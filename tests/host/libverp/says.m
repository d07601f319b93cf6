% Holds that `call` is an error whose message has these words in it.
function says(call, words)
  try
    call();
  catch thrown
    assert(~isempty(strfind(thrown.message, words)), ['says: ' thrown.message]);  %#ok<STREMP>
    return;
  end
  error('no error, but "%s" was to come', words);
end
