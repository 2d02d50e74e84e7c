// placeholder until first source
